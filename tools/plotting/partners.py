# SPDX-License-Identifier: BSD-3-Clause
"""Rigid partners of contact, drawn into pictures of plane scenes where they are at rest."""

import numpy as np


def outlines(run):
    """Closed polygons [corner, i] around the rooms of frames, which pictures should show whole."""
    found = []
    for partner in resting(run):
        if partner["type"] == "frame":
            (left, bottom), (right, top) = partner["low"], partner["high"]
            corners = [(left, bottom), (right, bottom), (right, top), (left, top), (left, bottom)]
            found.append(np.array(corners, dtype=float))
    return found


def draw(axis, run, factor):
    """Draws all resting partners; lengths are multiplied by `factor`."""
    looks = {"color": "0.45", "lw": 1.2, "zorder": 0}
    for polygon in outlines(run):
        axis.plot(*(polygon * factor).T, **looks)
    for partner in resting(run):
        if partner["type"] == "half_space":
            x, y = np.array(partner["point"]) * factor
            normal = partner["normal"]
            axis.axline((x, y), (x + normal[1], y - normal[0]), **looks)
        elif partner["type"] in ("ball", "cavity"):
            angle = np.linspace(0, 2 * np.pi, 200)
            circle = partner["radius"] * np.array([np.cos(angle), np.sin(angle)])
            axis.plot(*(factor * (np.array(partner["centre"])[:, None] + circle)), **looks)


def resting(run):
    """Tables [contact.partner] of partners without a prescribed motion; none in 3D."""
    if run.input["dimension"] == 3:
        return
    for contact in run.input.get("contact", []):
        partner = contact.get("partner")
        if partner and not partner.get("displacement"):
            yield partner
