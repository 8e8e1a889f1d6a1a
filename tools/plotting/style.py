# SPDX-License-Identifier: BSD-3-Clause
"""Looks shared by all pictures: fonts, colours, and numbers with units that can be read."""

import os
import pathlib
import re
import sys

import matplotlib.pyplot as plt
import numpy as np

# The command by which a script was called, for messages.
COMMAND = os.environ.get("MENISCUS_COMMAND", f"tools/{pathlib.Path(sys.argv[0]).stem}")
DPI = 200


class UsageError(ValueError):
    """An option asks for something that is not there."""


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


SUPERSCRIPTS = str.maketrans("0123456789-", "⁰¹²³⁴⁵⁶⁷⁸⁹⁻")


def pretty(unit):
    """As it is printed: µm, ag/(nm ps²), m⁻¹; degrees are ° alone."""
    if unit == "deg":
        return "°"
    unit = re.sub(r"\^(-?\d+)", lambda power: power.group(1).translate(SUPERSCRIPTS), unit)
    return re.sub(r"\bu(?=[a-zA-Z])", "µ", unit).replace("*", " ")


def label(text, unit):
    return f"{text} ({unit})" if unit else text


# Descriptive names of fields and measures with short keys.
WORDS = {
    "von_mises": "von Mises stress", "J": "volume ratio J", "F": "deformation gradient F",
    "P": "first Piola stress P", "ca": "capillary number", "p2": "second mode $p_2$", "min_J": "least volume ratio J",
    "isoperimetric": "isoperimetric ratio", "base_radius": "base radius", "evans_fung_rms": "difference from Evans and Fung",
    "contact_angle_vh": "contact angle of volume and height", "dt": "time step", "spin": "angular momentum",
    "aspect": "aspect ratio", "state_error": "error of the state", "profile_rms": "difference from the profile",
}  # fmt: skip
AXES = {"x": "$x$", "y": "$y$", "z": "$z$"}


def column_name(name):
    """A key in words: von Mises stress, force x, contact angle."""
    if name in WORDS:
        return WORDS[name]
    stem, _, axis = name.rpartition("_")
    if stem and axis in AXES:
        return f"{column_name(stem)} {AXES[axis]}"
    return name.replace("_", " ")


def time_text(time, unit, factor):
    return f"$t$ = {time * factor:.3g} {unit}"
