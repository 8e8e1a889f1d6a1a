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
TAKES_PREFIX = {"s", "m", "J", "J/m", "Pa", "N", "N/m", "m/s"}


def scale(unit, values):
    """(factor, unit) in which `values`, given in `unit`, are numbers between 1 and 1000."""
    size = np.max(np.abs(values), initial=0)
    if unit == "1":
        return 1, ""
    if unit not in TAKES_PREFIX or not np.isfinite(size) or size == 0:
        return 1, pretty(unit)
    power = int(np.clip(3 * np.floor(np.log10(size) / 3), min(PREFIXES), max(PREFIXES)))
    return 10.0**-power, PREFIXES[power] + unit


def pretty(unit):
    return unit.replace("^2", "²").replace("^3", "³").replace("*", " ")


def label(text, unit):
    return f"{text} ({unit})" if unit else text


def column_name(name):
    return name.replace("_", " ")


def time_text(time, unit, factor):
    return f"$t$ = {time * factor:.3g} {unit}"
