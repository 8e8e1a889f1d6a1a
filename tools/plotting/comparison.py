# SPDX-License-Identifier: BSD-3-Clause
"""Measures of several runs of like bodies over one time axis, e.g. of two forms of surface tension."""

import matplotlib.pyplot as plt
import numpy as np

import style
from histories import column

# Widest ratio of values that a linear axis still shows.
LINEAR_RATIO = 100
# Values below this fraction of the largest value are not drawn on a logarithmic axis.
ROUND_OFF = 1e-10


def draw(runs, names):
    """`runs` by label; `names` of columns of their histories (default: all measures they share)."""
    shared = [n for n in first(runs).history if all(n in r.history for r in runs.values())]
    names = names or [n for n in shared if "." in n]
    if missing := [n for n in names if n not in shared]:
        raise style.UsageError(f"not in all histories: {', '.join(missing)}; those share {', '.join(shared)}")
    figure, axes = plt.subplots(
        len(names), 1, figsize=(4.6, 2.2 * len(names) + 0.3), sharex=True, squeeze=False,
        layout="constrained",
    )  # fmt: skip
    for axis, name in zip(axes[:, 0], names):
        panel(axis, runs, name)
    axes[0, 0].legend()
    longest = max((r.history["time"] for r in runs.values()), key=lambda t: t[-1])
    axes[-1, 0].set_xlabel(style.label("time", style.scale(first(runs).time_unit, longest)[1]))
    axes[-1, 0].set_xlim(0, None)
    return {"comparison": figure}


def first(runs):
    return next(iter(runs.values()))


def panel(axis, runs, name):
    values = {label: run.history[name] for label, run in runs.items()}
    together = np.concatenate(list(values.values()))
    factor, unit = style.scale(first(runs).units[name], together)
    visible = together[together > ROUND_OFF * together.max()]
    if np.all(together >= 0) and together.max() > LINEAR_RATIO * visible.min(initial=np.inf):
        axis.set_yscale("log")
        values = {label: np.where(v >= visible.min(), v, np.nan) for label, v in values.items()}
    for label, run in runs.items():
        time = run.history["time"]
        time = time * style.scale(run.time_unit, time)[0]
        axis.plot(time, values[label] * factor, label=label)
    axis.set_ylabel(style.label(column(name), unit))
