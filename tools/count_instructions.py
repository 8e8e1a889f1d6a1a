#!/usr/bin/python3
"""Instructions of small scenes by effect (see tools/instructions).

The name of a function determines its effect; an outlined loop belongs to the function that contains it.
Functions that register materials and describe keys run at every start and belong to no effect.
"""

import argparse
import collections
import os
import pathlib
import re
import subprocess
import sys
import tempfile

EFFECTS = {
    "surface tension": r"SurfaceForce<|SurfaceTension<|_surface_tension<",
    "patches": r"SurfacePatches<[23]>::",
    "coefficient damping": r"CoefficientDamping<|coefficient_damping<",
    "curvature": r"CurvatureSurfaceTension<|hessian_along|\(meniscus::Derivatives\)2",
    # The viscous stress is inlined into the loop over stress points of the viscous law.
    "viscosity": r"InternalForce<[23], (?!meniscus::WithoutViscosity).*Newtonian|viscous_stress",
    "implicit viscosity": r"ImplicitViscosity<|add_viscous",
    "cell average": r"InternalForce<[23], meniscus::CellAverage<",
    "internal force": r"InternalForce<",
    "contact": r"(Pair|Rigid)Contact<|PairSums|PairVisits<|BodyAndPartner<|PartnerLayer<|Gap(Pair|Forces)<|"
    r"(Contact|Patch)Points<|(Contact|Reach)List<|sum_over_partners|contact_demand",
}

BODY = """
dimension = 3
time = { end = 0.5 }
[[body]]
name = "body"
"""
SOLID = 'material = { type = "neo_hookean", density = 1, mu = 1, lambda = 1 }\n'
CUBE = BODY + 'shape = "box"\nsize = [1, 1, 1]\ncells = [3, 3, 3]\n'
DROP = (
    BODY + 'shape = "ball"\nradius = 1\ncore = 2\nlayers = 1\n'
    'material = { type = "newtonian", density = 1, bulk_modulus = 20, viscosity = 0.3 }\n'
)
SPIN = 'initial_velocity = ["0.01*y", "-0.01*x", "0"]\n'
TENSION = '[[surface_tension]]\nbody = "body"\ngamma = 0.01\n'

PLATE = (
    '[[contact]]\nbodies = ["body"]\nepsilon = 1\nsigma0 = 0.2\nbeta = 1\n'
    'partner = { type = "half_space", point = [0, 0, -0.65], normal = [0, 0, 1] }\n'
)

# [name of the scene] its text and its effects
SCENES = {
    "elastic cube": (CUBE + SPIN + SOLID, {"internal force"}),
    "elastic cube, cell average": (
        CUBE + 'volumetric = "cell_average"\n' + SPIN + SOLID,
        {"internal force", "cell average"},
    ),
    "drop without viscosity": (DROP.replace("viscosity = 0.3", "viscosity = 0"), {"internal force"}),
    "viscous drop": (DROP, {"internal force", "viscosity"}),
    "viscous drop, implicit": (
        DROP.replace("end = 0.5", 'end = 0.5, viscosity = "implicit"'),
        {"internal force", "viscosity", "implicit viscosity"},
    ),
    "elastic cube on a plate": (CUBE + SOLID + PLATE, {"internal force", "contact"}),
    "elastic cube, tension": (
        CUBE + SOLID + TENSION,
        {"internal force", "surface tension", "patches"},
    ),
    "elastic cube, tension at Gauss points": (
        CUBE + SOLID + TENSION + 'form = "weak"\n',
        {"internal force", "surface tension"},
    ),
    "viscous drop, tension": (
        DROP + TENSION,
        {"internal force", "viscosity", "surface tension", "patches", "coefficient damping"},
    ),
    "viscous drop, tension at Gauss points": (
        DROP + TENSION + 'form = "weak"\n',
        {"internal force", "viscosity", "surface tension"},
    ),
    "viscous drop, tension by curvature": (
        DROP + TENSION + 'form = "curvature"\n',
        {"internal force", "viscosity", "surface tension", "curvature"},
    ),
}


def instructions(profile):
    """Instructions of every function itself, from the output of callgrind."""
    names, count, function, is_call = {}, collections.Counter(), None, False
    for line in profile.read_text().splitlines():
        if line.startswith("fn="):
            number, _, name = line[3:].partition(" ")
            function = names.setdefault(number, name)
        elif line.startswith("cfn="):
            number, _, name = line[4:].partition(" ")
            names.setdefault(number, name)
        elif line.startswith("calls="):
            is_call = True
        elif re.match(r"[0-9+*-]", line):
            if not is_call:  # otherwise the line counts the called function
                count[function] += int(line.split()[1])
            is_call = False
    return count


def measure(program, text, folder):
    (folder / "scene.toml").write_text(text)
    profile = folder / "profile"
    done = subprocess.run(
        ["valgrind", "--tool=callgrind", f"--callgrind-out-file={profile}",
         program, "run", folder / "scene.toml", "--output", folder / "out", "--overwrite", "-q"],
        # With these options set, the program does not restart itself, which valgrind cannot follow.
        env=dict(os.environ, OMP_NUM_THREADS="1", GLIBC_TUNABLES="", OMP_WAIT_POLICY="passive"), capture_output=True, text=True,
    )  # fmt: skip
    if done.returncode:
        sys.exit(f"the program failed under callgrind:\n{done.stdout}{done.stderr}")
    return instructions(profile)


def main():
    arguments = argparse.ArgumentParser(description=__doc__)
    arguments.add_argument("program", type=pathlib.Path, metavar="PROGRAM")
    program, wrong = arguments.parse_args().program.resolve(), []
    if not program.is_file():
        arguments.error(f"there is no program {program}")
    print("| instructions of | " + " | ".join(EFFECTS) + " | all |")
    print("|---" * (len(EFFECTS) + 2) + "|")
    with tempfile.TemporaryDirectory() as folder:
        for scene, (text, has) in SCENES.items():
            count = measure(program, text, pathlib.Path(folder))
            row = []
            for effect, pattern in EFFECTS.items():
                own = sum(n for name, n in count.items()
                          if re.search(pattern, name) and "register_" not in name)
                row.append(own)
                if (own > 0) != (effect in has):
                    wrong.append(f"{scene}: {own} instructions of {effect}")
            row.append(sum(count.values()))
            print(f"| {scene} | " + " | ".join(map(str, row)) + " |", flush=True)
    for line in wrong:
        print("WRONG:", line)
    sys.exit(1 if wrong else 0)


if __name__ == "__main__":
    main()
