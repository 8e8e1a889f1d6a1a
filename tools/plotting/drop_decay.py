# SPDX-License-Identifier: BSD-3-Clause
"""Decay of the second mode of a viscous drop beside the exact rate of small oscillations."""

import matplotlib.pyplot as plt
import numpy as np

import drop_theory
import style


def draw(run):
    pictures = {}
    for body in run.bodies:
        gamma = tension(run, body)
        if applies(run, body, gamma):
            pictures[f"{body.name}_decay"] = decay(run, body, gamma)
    return pictures


def tension(run, body):
    terms = run.input.get("surface_tension", [])
    return sum(term["gamma"] for term in terms if term["body"] == body.name)


def applies(run, body, gamma):
    """True for a free ellipsoidal drop of a Newtonian liquid in 3D whose p2 is recorded."""
    return (
        body.dimension == 3
        and body.settings["shape"] == "ellipsoid"
        and body.settings["material"]["type"] == "newtonian"
        and isinstance(gamma, float)
        and gamma > 0
        and f"{body.name}.p2" in run.history
    )


def decay(run, body, gamma):
    material = body.settings["material"]
    density, viscosity = material["density"], material["viscosity"]
    radius = np.prod(body.settings["semi_axes"]) ** (1 / 3)
    period = np.sqrt(density * radius**3 / gamma)
    ohnesorge = viscosity / np.sqrt(density * gamma * radius)
    rate = drop_theory.slow_rate(ohnesorge)

    time, p2 = run.history["time"], run.history[f"{body.name}.p2"]
    factor, unit = style.scale(run.time_unit, time)
    figure, axis = plt.subplots(figsize=(4.6, 3.2), layout="constrained")
    axis.semilogy(time * factor, np.abs(p2), label="simulation")
    mode = slow_mode(time / period, p2, rate)
    axis.semilogy(time * factor, np.abs(mode), "--", label="exact slow mode, fitted amplitude")
    axis.set_xlabel(style.label("time", unit))
    axis.set_ylabel(r"$|p_2|$")
    axis.set_xlim(0, time[-1] * factor)
    axis.set_ylim(np.abs(p2[0]) * 1e-4, np.abs(p2[0]) * 2)
    axis.legend(title=rf"Oh = {ohnesorge:.4g}, {rate_text(rate / period, run.time_unit)}")
    return figure


FIT = (1.5, 2.5)  # in periods: before it is nonlinear, afterwards too small for the resolution


def slow_mode(time, p2, rate):
    """A exp(-sigma t), or with a cosine of fitted phase; fitted where the amplitude is small."""
    waves = [np.exp(-rate * time).real]
    if isinstance(rate, complex):
        waves.append(np.exp(-rate * time).imag)
    waves = np.array(waves).T
    fitted = (time >= FIT[0]) & (time <= FIT[1])
    if not fitted.any():
        fitted = time == time[-1]
    # Relative errors count: the mode decays by factors inside the window.
    weight = np.exp(np.real(rate) * time[fitted])[:, None]
    amplitudes = np.linalg.lstsq(waves[fitted] * weight, p2[fitted] * weight[:, 0], rcond=None)[0]
    return waves @ amplitudes


def rate_text(rate, unit):
    power = int(np.floor(np.log10(abs(rate))))
    digits = rate / 10.0**power
    if isinstance(rate, complex):
        number = rf"({digits.real:.4f} \pm {digits.imag:.4f}\,i)"
    else:
        number = f"{digits:.4f}"
    return rf"$\sigma = {number} \times 10^{{{power}}}$ {unit}$^{{-1}}$"
