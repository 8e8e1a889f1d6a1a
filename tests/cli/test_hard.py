#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Hard scenes: each ends with the exit code and says the word of its row; nothing that is written is
not a number, and in no frame is a particle of one body inside another. Usage: test_hard.py PROGRAM
[NAME...]"""
import itertools
import re
import resource
import sys
import tempfile
import subprocess
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import h5py
import numpy as np

from program import ENVIRONMENT

SOFT = 'material = { type = "neo_hookean", density = 1, mu = 0.4, lambda = 0.6 }\n'
RUBBER = 'material = { type = "mooney_rivlin", density = 1, c1 = 0.15, c2 = 0.04, lambda = 0.2 }\n'
STIFF = 'material = { type = "neo_hookean", density = 1, mu = 400, lambda = 300 }\n'


def head(end, *more, dimension=2):
    return "\n".join([f"dimension = {dimension}", "[time]", f"end = {end}", *more, ""])


def body(name, shape, material, *more):
    return "\n".join(["[[body]]", f'name = "{name}"', shape, *more, material])


def sheet(material, *more, cells=(5, 5), size=(1, 1)):
    return body("sheet", f'shape = "rectangle"\nsize = {list(size)}\ncells = {list(cells)}', material, *more)


def box(material, *more, cells=(4, 4, 4), size=(1, 1, 1)):
    return body("box", f'shape = "box"\nsize = {list(size)}\ncells = {list(cells)}', material, *more)


def disk(name, centre=(0, 0), radius=1.0, velocity=(0, 0), *more, material=STIFF, core=4):
    return body(name, f'shape = "disk"\nradius = {radius}\ncore = {core}\nrings = {max(1, core // 2)}\n'
                f"centre = {list(centre)}\ninitial_velocity = {list(velocity)}", material, *more)


def let_go(stretch, material, end, *time):
    """A bar that is released from a stretch without change of volume."""
    across = stretch**-0.5 - 1
    return head(end, *time, "[output]", "history_every = 0.05", dimension=3) + box(
        material, f'initial_displacement = ["{stretch - 1}*x", "{across}*y", "{across}*z"]', cells=(12, 3, 3),
        size=(4, 1, 1))


def force(name, *components):
    return f'[[body_force]]\nbody = "{name}"\nacceleration = {list(components)}\n'


def contact(bodies, *more, epsilon=1, sigma0=0.4, partner=""):
    table = f'[[contact]]\nname = "contact"\nbodies = {list(bodies)}\nepsilon = {epsilon}\nsigma0 = {sigma0}\nbeta = 1\n'
    return table.replace("'", '"') + "\n".join(more) + (f"\npartner = {{ {partner} }}\n" if partner else "\n")


def drop(shape, *more, viscosity=0.3, gamma=1, bulk=200, tension=""):
    fluid = f'material = {{ type = "newtonian", density = 1, bulk_modulus = {bulk}, viscosity = {viscosity} }}\n'
    return (body("drop", shape, fluid, *more) +
            f'[[surface_tension]]\nbody = "drop"\ngamma = {gamma}\n{tension}\n')


ROUND = 'shape = "disk"\nradius = 1\ncore = 4\nrings = 2'
ELLIPSE = 'shape = "ellipse"\nsemi_axes = [0.8, 1.25]\ncore = 4\nrings = 2'
BALL = 'shape = "ball"\nradius = 1\ncore = 3\nlayers = 1'
SHELL = ('shape = "sphere_shell"\nradius = 1\nthickness = 0.5\nlayers = 4\nspacing = 0.8')
# The ellipsoid has the volume of the unit sphere. At rest it is compressed by 2/K.
LONG = 'shape = "ellipsoid"\nsemi_axes = [0.793701, 1.587401, 0.793701]\ncore = 4\nlayers = 2'
LONG_DROP = """
[expect]
area_of_the_ellipsoid = { of = "drop.area", at = 0, value = 13.530566, within_relative = 1e-3 }
least_isoperimetric = { of = "drop.isoperimetric", reduce = "min", value = 1.0005, within = 1e-3 }
volume = { of = "drop.volume", value = 4.1804, within_relative = 2e-3 }
round = { of = "drop.aspect", value = 1, within = 0.05 }
"""
RELAX = 'solver = "relax"'
NEWTON = 'solver = "newton"'
BALANCED = """
[expect]
balance = { of = "energy_balance_error", reduce = "max_abs", value = 0, within = 1e-2 }
"""
SWIRL = 'initial_velocity = ["0.02*sin(pi*x)*cos(pi*y)", "-0.02*cos(pi*x)*sin(pi*y)"]'
LEFT, RIGHT = disk("left", (-1.3, 0), 1, (3, 0)), disk("right", (1.3, 0.2), 1, (-3, 0))
THROWN, TARGET = disk("small", (-1.6, 0.07), 0.4, (3, 0), core=3), disk("large")
PLATE = 'type = "half_space", point = [0, {}], normal = [0, 1]{}'


def law(mu, lame, density=1):
    return f'material = {{ type = "neo_hookean", density = {density}, mu = {mu}, lambda = {lame} }}\n'


def cavity(*more):
    return '[[cavity]]\nbody = "cell"\npenalty = 10\n' + "\n".join(more) + "\n"


def cell(*more):
    return body("cell", SHELL, 'material = { type = "mooney_rivlin", density = 1, c1 = 1, c2 = 0.1, lambda = 20 }\n',
                *more)


def pressed(name, pressure):
    return f'[[traction]]\nbody = "{name}"\nface = "outer"\npressure = {pressure}\nramp = [0, 20]\n'


def gripped(pull):
    return sheet(SOFT, cells=(16, 5), size=(1, 0.3)) + (
        '[[held]]\nbody = "sheet"\nface = "x_min"\n'
        f'[[held]]\nbody = "sheet"\nface = "x_max"\ndisplacement = [{pull}, 0]\nramp = [0, 2]\n')


DROPS = "".join(drop(f'shape = "disk"\nradius = 1\ncore = 4\nrings = 2\ncentre = [{x}, {y}]',
                     f"initial_velocity = [{-x}, 0]").replace('"drop"', f'"{name}"')
                for name, x, y in (("left", -1.2, 0), ("right", 1.2, 0.2)))
CURLED = """
[[held]]
body = "sheet"
face = "x_min"
displacement = [0, 0]
[[held]]
body = "sheet"
face = "x_max"
angle = "max(0.28*t, 1e-6)"
centre = [5, 0]
displacement = ["10/max(0.28*t, 1e-6)*sin(max(0.28*t, 1e-6)) - 10",
                "10/max(0.28*t, 1e-6)*(1 - cos(max(0.28*t, 1e-6)))"]
"""

# name, scene, exit code, word in the output or the log
TABLE = [
    # Particles and rules
    ("jitter 40 %", head(2) + sheet(SOFT, "jitter = 0.4", SWIRL), 0, ""),
    ("jitter 60 %", head(2) + sheet(SOFT, "jitter = 0.6"), 3, "body[0].jitter"),
    ("bar let go at 0.6 of its length", let_go(0.6, SOFT, 12) + BALANCED, 0, ""),
    ("bar let go at half its length, Mooney-Rivlin", let_go(0.5, RUBBER, 12) + BALANCED, 0, ""),
    # Beyond about twice its length, such a bar folds or not by chance, with supports of any width.
    ("bar let go at 1.7 of its length, fixed step", let_go(1.7, SOFT, 2, "step = 0.13"), 0, "energy balance is off by"),
    ("cells 10 : 1", head(1) + sheet(SOFT, SWIRL, size=(1, 0.1)), 0, ""),
    ("cells 100 : 1", head(0.1) + sheet(SOFT, SWIRL, size=(1, 0.01)), 0, ""),
    ("one layer of cells", head(1) + sheet(SOFT, cells=(6, 1)), 3, "body[0]: body 'sheet': the shape functions"),
    ("one cell", head(1) + sheet(SOFT, cells=(1, 1)), 3, "body[0]"),
    ("no cells", head(1) + sheet(SOFT, cells=(0, 4)), 3, "body[0].cells"),
    ("more cells than memory", head(1) + sheet(SOFT, cells=(9000, 9000)), 3, "GB of memory"),
    ("supports of 1.6 spacings", head(2) + sheet(SOFT, "support_spacings = 1.6", SWIRL), 0, "were enlarged"),
    ("supports of 6 spacings", head(1) + sheet(SOFT, "support_spacings = 6", SWIRL), 0, ""),
    ("a Gauss point per cell", head(1) + sheet(SOFT, 'integration = "gauss"', "gauss_points = 1", SWIRL), 0, ""),
    ("nodal integration", head(0.5) + sheet(SOFT, 'integration = "nodal"', SWIRL), 0, "modes without energy"),
    ("box of 4^3 cells", head(1, dimension=3) + box(SOFT, "jitter = 0.3"), 0, ""),
    # Numbers far from one
    ("lambda/mu = 1e4, full", head(0.1) + sheet(law(1, 1e4), 'volumetric = "full"', SWIRL), 0, ""),
    ("lambda/mu = 1e4, averaged", head(0.1) + sheet(law(1, 1e4), SWIRL), 0, ""),
    ("lambda = 0", head(1) + sheet(law(1, 0), SWIRL), 0, ""),
    ("mu = 0", head(1) + sheet(law(0, 1)), 3, "material.mu"),
    ("modulus 1e18", head(1e-9) + sheet(law(1e18, 1e18), SWIRL), 0, ""),
    ("density 1e-12", head(1e-6) + sheet(law(1, 1, 1e-12), SWIRL), 0, ""),
    ("size 1e-9", head(1e-9) + sheet(SOFT, cells=(4, 4), size=(1e-9, 1e-9)), 0, ""),
    ("size 1e12", head(1e12) + sheet(SOFT, cells=(4, 4), size=(1e12, 1e12)), 0, ""),
    ("end after a millionth of a step", head(1e-8) + sheet(SOFT, SWIRL), 0, ""),
    # Steps
    ("step above the limit", head(1, "step = 1") + sheet(SOFT), 3, "stable step"),
    ("step of a hundredth of the limit", head(0.1, "step = 0.001") + sheet(SOFT, SWIRL), 0, ""),
    ("safety 1.1", head(1, "safety = 1.1") + sheet(SOFT), 3, "time.safety"),
    # Motion
    ("inverted from the start", head(1) + sheet(SOFT, 'initial_displacement = ["-2*x", 0]'), 3, "J = det F"),
    ("pushed together", head(1) + sheet(SOFT, 'initial_velocity = ["-1000*x", 0]'), 4, "J = det F"),
    ("impact at 0.3 c", head(2) + sheet(SOFT, 'initial_velocity = ["-0.348*tanh(20*x)", 0]'), 0, ""),
    ("velocity is no number", head(1) + sheet(SOFT, 'initial_velocity = ["log(x - 9)", 0]'), 3, "not a number"),
    ("force is no number at the start", head(1) + sheet(SOFT) + force("sheet", "1/t", 0), 3, "infinite"),
    ("force is no number later", head(1) + sheet(SOFT) + force("sheet", "sqrt(0.1 - t)", 0), 4, "not a number"),
    ("pushed through itself by newton", head(2, NEWTON, "step = 1") + gripped(-0.9), 4, "the surface goes through itself"),
    ("pushed through its grip by newton", head(2, NEWTON, "step = 1") + gripped(-1.5), 4, "particle"),
    ("pulled to 30 times its length by newton", head(2, NEWTON, "step = 1") + gripped(30), 0, ""),
    ("force of 1e6 g", head(1) + sheet(SOFT) + force("sheet", 0, "-1e7*(1 + y)"), 4, "J = det F"),
    ("falling for long", head(100) + sheet(SOFT, cells=(3, 3)) + force("sheet", 0, -10), 0, ""),
    # Rest
    ("relaxed drop", head(60, RELAX) + drop(ROUND, 'initial_displacement = ["0.1*x", "-0.09*y"]'), 0, "at rest"),
    ("relaxed body that drifts", head(90, RELAX) + sheet(SOFT, "initial_velocity = [0.003, 0.001]"), 0, "at rest"),
    ("relaxed body that is pulled", head(20, RELAX) + sheet(SOFT) + force("sheet", 0, -0.02), 4, "net force"),
    ("relaxed under a load without end", head(9, RELAX) + sheet(SOFT) + force("sheet", "sin(t)", 0), 3, "no rest"),
    ("relaxed for too short", head(0.5, RELAX) + sheet(SOFT, 'initial_displacement = ["0.1*y^2", 0]'), 4, "more time"),
    # Drops
    ("drop 1 : 1.6 at Oh 0.01", head(2) + drop(ELLIPSE, viscosity=0.01), 0, ""),
    ("inviscid drop", head(1) + drop(ELLIPSE, viscosity=0), 0, ""),
    ("drop of honey", head(0.02) + drop(ELLIPSE, viscosity=100), 0, ""),
    ("square drop", head(1) + drop('shape = "rectangle"\nsize = [1.6, 1.6]\ncells = [6, 6]'), 0, ""),
    ("square drop by curvature", head(1) + drop('shape = "rectangle"\nsize = [1.6, 1.6]\ncells = [6, 6]',
                                                tension='form = "curvature"'), 3, "edges"),
    ("spun drop", head(2) + drop(ROUND, 'initial_velocity = ["-0.3*y", "0.3*x"]'), 0, ""),
    ("drop as soft as its tension", head(1) + drop(ROUND, bulk=1), 0, ""),
    ("drop of 2 : 4 : 2 cells, weak form",
     head(8, dimension=3) + drop('shape = "ellipsoid"\nsemi_axes = [0.8, 1.6, 0.8]\ncore = 2\nlayers = 1',
                                 tension='form = "weak"\npoints = 2'), 4, "isoperimetric"),
    ("drop 1 : 2 : 1", head(2.5, dimension=3) + drop(LONG, viscosity=0.93, bulk=1000) + LONG_DROP, 0, ""),
    ("drop 1 : 2 : 1, weak form", head(2.5, dimension=3) + drop(LONG, viscosity=0.93, bulk=1000,
                                                                tension='form = "weak"') +
     LONG_DROP + 'J = { of = "drop.min_J", reduce = "min", value = 0.998, within = 1e-2 }\n', 0, ""),
    ("drop with two surface laws", head(1) + drop(ROUND) + '[[surface]]\nbody = "drop"\n'
     'law = { type = "tension", gamma = 1 }\n', 3, "has a law already"),
    # Contact
    ("first contact at 0.2 c", head(0.4) + LEFT + RIGHT + contact(["left", "right"], epsilon=30), 0, ""),
    ("first contact at 2 c", head(0.1) + disk("left", (-1.3, 0), 1, (30, 0)) + disk("right", (1.3, 0.2), 1, (-30, 0)) +
     contact(["left", "right"], epsilon=30), 4, "particle"),
    ("start in overlap", head(1) + disk("left", (-1, 0)) + disk("right", (1.05, 0)) + contact(["left", "right"]), 3,
     "surfaces overlap"),
    ("start inside", head(1) + disk("small", (0.1, 0), 0.4) + TARGET + contact(["small", "large"], sigma0=0.1), 3,
     "is inside of body"),
    ("points that miss each other", head(0.45) + THROWN + TARGET +
     contact(["small", "large"], "points = 2", sigma0=0.001), 3, "go through each other"),
    ("through a surface", head(0.4) + disk("left", (-1.2, 0), 1, (1.5, 0), core=6) +
     disk("right", (1.2, 0.3), 1, (-1.5, 0), core=6) + contact(["left", "right"], "points = 2", sigma0=0.05), 4,
     "particle"),
    ("thrown at a wall", head(0.6) + disk("ball", (0, 1.5), 1, (0, -3)) +
     contact(["ball"], epsilon=30, partner=PLATE.format(0, "")), 0, ""),
    ("behind a wall", head(1) + TARGET + contact(["large"], partner=PLATE.format(0, "")), 3, "surfaces overlap"),
    ("wall that goes on", head(2) + disk("ball", (0, 1.3)) +
     contact(["ball"], partner=PLATE.format(0, ', displacement = [0, "20*t"]')), 4,
     "comes through this contact; a shorter sigma0 or more epsilon hold more"),
    ("run over a pin", head(0.4) + THROWN +
     contact(["small"], epsilon=1e-3, sigma0=0.01, partner='type = "ball", centre = [-0.9, 0.15], radius = 0.01'), 4,
     "rigid partner"),
    ("pin inside", head(1) + TARGET +
     contact(["large"], sigma0=0.02, partner='type = "ball", centre = [0.1, 0], radius = 0.02'), 3, "rigid partner"),
    ("tip of radius 0.6 sigma0", head(1) + disk("tip", (0, 0.9), 0.24, (0, -1)) +
     contact(["tip"], epsilon=4, partner=PLATE.format(0, "")), 0, ""),
    ("ball in a cavity", head(1) + TARGET + contact(["large"], partner='type = "cavity", centre = [0, 0], radius = 1.3'),
     0, ""),
    ("body outside of its frame", head(1) + disk("ball", (9, 0)) +
     contact(["ball"], partner='type = "frame", low = [-4, -4], high = [4, 4]'), 3, "surfaces overlap"),
    ("wall without direction", head(1) + TARGET +
     contact(["large"], partner='type = "half_space", point = [0, -2], normal = [0, 0]'), 3, "no direction"),
    ("contact of volumes", head(0.3) + LEFT + RIGHT + contact(["left", "right"], 'form = "volume"', epsilon=30), 0, ""),
    ("contact of the dissertation", head(0.3) + LEFT + RIGHT + contact(["left", "right"], 'form = "dissertation"', epsilon=30), 0,
     "not the gradient"),
    # Surfaces that pass through themselves or each other
    ("drops without a contact", head(1.5) + DROPS, 4, "nothing keeps them apart: add a [[contact]] with bodies = "),
    ("blocks that overlap", head(1) + TARGET + disk("small", (1.1, 0), 0.4), 3, "move them farther apart"),
    ("hollow ball pressed flat", head(30, RELAX, dimension=3) + body(
        "ball", 'shape = "sphere_shell"\nradius = 1\nthickness = 0.12\nlayers = 3\nspacing = 0.25', law(1, 10)) +
     pressed("ball", 0.5), 4, "the surface goes through itself"),
    ("ring pressed flat", head(60, RELAX) + body(
        "ring", 'shape = "ring"\nradius = 1\nthickness = 0.2\naround = 48\nlayers = 3', law(1, 10)) +
     pressed("ring", 0.1), 4, "the surface goes through itself"),
    ("strip bent beyond a circle", head(30) + sheet(law(100, 100), cells=(60, 3), size=(10, 0.5)) + CURLED, 4,
     "a body has no contact with itself"),
    # Shells
    ("shell that swells", head(0.5, dimension=3) + cell() + cavity("volume_target = 1.2", "ramp = [0, 0.4]"), 0, ""),
    ("shell around a wall too thick", head(1, dimension=3) + cell().replace("thickness = 0.5", "thickness = 3") +
     cavity("volume_target = 0.9"), 3, "body[0].shape"),
]


def run(program, directory, number, scene):
    folder = directory / str(number)
    folder.mkdir()
    (folder / "scene.toml").write_text(scene)
    done = subprocess.run([program, "run", "scene.toml", "--output", "out", "--threads", "1"], cwd=folder, text=True,
                          capture_output=True, env=ENVIRONMENT, timeout=300,
                          preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_CPU, (100, 100)))
    return done, folder / "out"


def arrays(group):
    for entry in group.values():
        if isinstance(entry, h5py.Group):
            yield from arrays(entry)
        elif entry.dtype.kind == "f":
            yield entry.name, entry[()]


def not_numbers(out):
    """Names of all values in the files of a run that are not finite."""
    wrong = []
    for path in [out / "run.h5", *out.glob("checkpoint-*.h5")]:
        with h5py.File(path) as file:
            wrong += [f"{path.name}{name}" for name, values in arrays(file) if not np.isfinite(values).all()]
    if not np.isfinite(np.loadtxt(out / "history.csv", delimiter=",")).all():
        wrong.append("history.csv")
    return wrong


def windings(facets, points):
    """Winding number of a closed curve around each of the points."""
    a, b = facets[None, :, 0] - points[:, None], facets[None, :, 1] - points[:, None]
    angles = np.arctan2(a[..., 0] * b[..., 1] - a[..., 1] * b[..., 0], (a * b).sum(-1))
    return angles.sum(1) / (2 * np.pi)


def deep_inside(facets, points):
    """Points inside a curve that are farther from the middle of each facet than 0.75 of its length."""
    edge = np.linalg.norm(facets[:, 1] - facets[:, 0], axis=1)
    away = np.linalg.norm(points[:, None] - facets.mean(1)[None], axis=2) > 0.75 * edge
    return (windings(facets, points) > 0.5) & away.all(1)


def bodies_in_each_other(out):
    """(body, other body, frame) for all 2D bodies of which a part is inside another body."""
    found = []
    with h5py.File(out / "run.h5") as file:
        bodies = {name: (slice(group.attrs["first_particle"], group.attrs["first_particle"] + group.attrs["particles"]),
                         group["surface"][:]) for name, group in file["reference"].items()}
        for k, (a, b) in itertools.product(range(len(file["steps"])), itertools.permutations(bodies, 2)):
            (part, facets), (other, _) = bodies[a], bodies[b]
            x = file[f"steps/{k}/position"][:, :2]
            if facets.shape[1] == 2 and deep_inside(x[part][facets], x[other]).any():
                found.append((b, a, k))
    return found


def verdict(program, directory, number, row):
    name, scene, code, word = row
    done, out = run(program, directory, number, scene)
    log = out / "run.log"
    said = done.stdout + done.stderr + (log.read_text() if log.exists() else "")
    wrong = []
    if done.returncode != code:
        wrong.append(f"exit code {done.returncode}, expected {code}: {done.stderr[-400:]}")
    elif word not in said:
        wrong.append(f"does not say '{word}': {said[-400:]}")
    if re.search(r"(?<![\w'])[-+]?nan\b", said):
        wrong.append("writes a number that is none")
    if (out / "run.h5").exists():
        wrong += [f"{name} is not finite" for name in not_numbers(out)]
        if done.returncode == 0:
            wrong += [f"'{a}' is in '{b}' in frame {k}" for a, b, k in bodies_in_each_other(out)[:1]]
    return [f"{name}: {text}" for text in wrong]


def main():
    program, *names = sys.argv[1:]
    rows = [row for row in TABLE if not names or row[0] in names]
    assert len({row[0] for row in rows}) == len(rows)
    with tempfile.TemporaryDirectory() as name, ThreadPoolExecutor(2) as pool:
        results = list(pool.map(lambda r: verdict(program, Path(name), *r), enumerate(rows)))
    wrong = list(itertools.chain(*results))
    print("\n".join(wrong))
    print(f"{len(rows)} hard scenes, {len(wrong)} wrong")
    sys.exit(bool(wrong))


if __name__ == "__main__":
    main()
