# SPDX-License-Identifier: BSD-3-Clause
"""Rigid partners of contact where they are in a frame: outlines in the plane, walls in space."""

import numpy as np
from matplotlib.collections import PolyCollection

LOOKS = {"color": "0.45", "lw": 1.2, "zorder": 0}
WALL, WALL_BEFORE = (0.55, 0.57, 0.60, 0.35), (0.55, 0.57, 0.60, 0.12)


def partners(run, frame):
    """(table [contact.partner], displacement) of those whose place in the frame is known."""
    tables = [contact["partner"] for contact in run.input.get("contact", []) if contact.get("partner")]
    for number, partner in enumerate(tables):
        moved = np.zeros(run.dimension)
        if partner.get("displacement"):
            moved = run.displacement_of_partner(frame, number)
        if moved is not None:
            yield partner, moved


def normals(run):
    """Of half spaces, and the directions up of ground: what sections should contain."""
    for contact in run.input.get("contact", []):
        partner = contact.get("partner")
        if partner and partner["type"] == "half_space":
            yield np.array(partner["normal"], dtype=float)
        elif contact.get("up"):
            yield np.array(contact["up"], dtype=float)


def near_walls(run, frame, points):
    """Places of half spaces and balls next to the bodies [wall, i], which pictures should show: those
    no farther than half of the extent of all points."""
    centre, extent = points.mean(axis=0), np.ptp(points, axis=0).max()
    found = []
    for partner, moved in partners(run, frame):
        if partner["type"] == "half_space":
            normal = np.array(partner["normal"], dtype=float)
            normal /= np.linalg.norm(normal)
            foot = centre - ((centre - np.array(partner["point"]) - moved) @ normal) * normal
        elif partner["type"] == "ball":
            away = centre - np.array(partner["centre"]) - moved
            foot = centre - away * (1 - partner["radius"] / np.linalg.norm(away))
        else:
            continue
        if np.linalg.norm(points - foot, axis=1).min() < extent / 2:
            found.append(foot)
    return np.array(found).reshape(-1, points.shape[1])


def outlines(run, frame=0):
    """Closed polygons [corner, i] around the rooms of frames, which pictures should show whole."""
    found = []
    for partner, moved in partners(run, frame):
        if partner["type"] == "frame":
            (left, bottom), (right, top) = partner["low"], partner["high"]
            corners = [(left, bottom), (right, bottom), (right, top), (left, top), (left, bottom)]
            found.append(np.array(corners, dtype=float) + moved)
    return found


def draw(axis, run, factor, frame, axes=(0, 1)):
    """Draws all partners of a plane scene, in a section along two `axes` of space the half spaces whose
    normals it contains; lengths are multiplied by `factor`."""
    if run.dimension == 3:
        for partner, moved in partners(run, frame):
            if partner["type"] == "half_space":
                line(axis, partner, moved, factor, list(axes))
        return
    for polygon in outlines(run, frame):
        axis.plot(*(polygon * factor).T, **LOOKS)
    for partner, moved in partners(run, frame):
        if partner["type"] == "half_space":
            line(axis, partner, moved, factor, [0, 1])
        elif partner["type"] in ("ball", "cavity"):
            angle = np.linspace(0, 2 * np.pi, 200)
            circle = partner["radius"] * np.array([np.cos(angle), np.sin(angle)])
            axis.plot(*(factor * ((np.array(partner["centre"]) + moved)[:, None] + circle)), **LOOKS)


def line(axis, partner, moved, factor, axes):
    """A half space, if its normal lies in the plane of these axes."""
    normal = np.array(partner["normal"], dtype=float)
    x, y = ((np.array(partner["point"]) + moved) * factor)[axes]
    across, up = normal[axes] / np.linalg.norm(normal)
    if np.hypot(across, up) > 0.999:
        axis.axline((x, y), (x + up, y - across), **LOOKS)


def walls(run, frame, axes_of_view, centre, width):
    """(collection, whether it is between the eye and the bodies) of half spaces and balls in space;
    a wall is a square of that width around the foot of the centre of what is seen."""
    for partner, moved in partners(run, frame):
        if partner["type"] == "half_space":
            normal = np.array(partner["normal"], dtype=float)
            normal /= np.linalg.norm(normal)
            point = np.array(partner["point"]) + moved
            foot = centre - ((centre - point) @ normal) * normal
            first = np.cross(normal, [1, 0, 0] if abs(normal[0]) < 0.7 else [0, 1, 0])
            first /= np.linalg.norm(first)
            second = np.cross(normal, first)
            lines = np.linspace(-width / 2, width / 2, 9)
            squares = [
                foot + a * first + b * second + np.outer(s, first) + np.outer(t, second)
                for a in lines[:-1] for b in lines[:-1]
                for s, t in [(np.array([0, 1, 1, 0]) * width / 8, np.array([0, 0, 1, 1]) * width / 8)]
            ]  # fmt: skip
            before = normal @ axes_of_view[2] < 0
            yield filled(np.array(squares) @ axes_of_view.T, before), before
        elif partner["type"] == "ball":
            place = (np.array(partner["centre"]) + moved) @ axes_of_view.T
            angle = np.linspace(0, 2 * np.pi, 120)
            circle = place[:2] + partner["radius"] * np.stack([np.cos(angle), np.sin(angle)], axis=1)
            before = place[2] > centre @ axes_of_view[2]
            yield filled(circle[None], before), before


def filled(polygons, before):
    color = WALL_BEFORE if before else WALL
    return PolyCollection(polygons[..., :2], facecolors=[color], edgecolors=[(1, 1, 1, 0.6)], linewidths=0.5)
