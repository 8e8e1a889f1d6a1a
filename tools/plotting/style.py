# SPDX-License-Identifier: BSD-3-Clause
"""Looks shared by all pictures: fonts, colours, and numbers with units that can be read."""

import matplotlib.pyplot as plt
import numpy as np

DPI = 200
# Distinguishable with any kind of colour vision (Okabe and Ito).
COLORS = ["#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9"]

plt.rcParams.update(
    {
        "font.family": "STIXGeneral",
        "mathtext.fontset": "stix",
        "font.size": 10,
        "axes.prop_cycle": plt.cycler(color=COLORS),
        "axes.spines.top": False,
        "axes.spines.right": False,
        "axes.linewidth": 0.8,
        "axes.formatter.useoffset": False,
        "axes.formatter.limits": (-3, 4),
        "axes.formatter.use_mathtext": True,
        "lines.linewidth": 1.4,
        "legend.frameon": False,
        "legend.fontsize": 9,
        "xtick.direction": "in",
        "ytick.direction": "in",
    }
)

PREFIXES = {
    -21: "z", -18: "a", -15: "f", -12: "p", -9: "n", -6: "µ", -3: "m", 0: "", 3: "k", 6: "M",
    9: "G", 12: "T",
}  # fmt: skip
# Units whose first symbol may take a prefix, and the power to which it then stands.
TAKES_PREFIX = {
    "s": 1, "m": 1, "m^2": 2, "m^3": 3, "J": 1, "J/m": 1, "Pa": 1, "N": 1, "N/m": 1, "m/s": 1,
}  # fmt: skip


def scale(unit, values):
    """(factor, unit) in which `values`, given in `unit`, are numbers between 1 and 1000 (or the
    square or cube of that)."""
    size = np.max(np.abs(values), initial=0)
    if unit == "1":
        return 1, ""
    if unit not in TAKES_PREFIX or not np.isfinite(size) or size == 0:
        return 1, pretty(unit)
    exponent = TAKES_PREFIX[unit]
    power = 3 * np.floor(np.log10(size) / (3 * exponent) + 1e-12)
    power = int(np.clip(power, min(PREFIXES), max(PREFIXES)))
    return 10.0 ** (-power * exponent), PREFIXES[power] + pretty(unit)


def pretty(unit):
    return unit.replace("^2", "²").replace("^3", "³").replace("*", " ")


def label(text, unit):
    return f"{text} ({unit})" if unit else text


def column_name(name):
    return name.replace("_", " ")


def time_text(time, unit, factor):
    return f"$t$ = {time * factor:.3g} {unit}"
