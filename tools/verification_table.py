#!/usr/bin/python3
"""Prints Markdown tables of the studies in directories: the number of checks met, and for each
method at its finest level the first error, the observed order from the level before, wall time
(set-up + method) and memory.
"""

import argparse
import json
import pathlib


def finest(measurements):
    """The last measurement of each method, in order of appearance."""
    return {m["method"]: m for m in measurements if m["errors"]}.values()


def row(study, m):
    name, error = next(iter(m["errors"].items()))
    order = m["orders"].get(name)
    cells = [
        study,
        m["method"],
        str(m["particles"]),
        f"{name} {error:.2g}" if error is not None else f"{name} -",
        f"{order:.1f}" if order is not None else "",
        f"{m['set_up']:.3g} + {m['time']:.3g}",
        f"{1e-6 * m['bytes']:.3g}",
    ]
    return "| " + " | ".join(cells) + " |"


def main():
    arguments = argparse.ArgumentParser(description=__doc__)
    arguments.add_argument("folders", type=pathlib.Path, nargs="*", metavar="DIR",
                           help="one without a study is passed over")
    folders, studies = arguments.parse_args().folders, []
    for folder in folders:
        if not folder.is_dir():
            arguments.error(f"there is no directory {folder}")
        if (folder / "study.json").is_file():
            studies.append(json.loads((folder / "study.json").read_text()))
    print("| study | checks met |")
    print("|---|---|")
    for study in studies:
        met = sum(check["met"] for check in study["checks"])
        print(f"| {study['study']} | {met} of {len(study['checks'])} |")
    print()
    print("| study | method | particles | error | order | time (s) | MB |")
    print("|---|---|---|---|---|---|---|")
    for study in studies:
        for m in finest(study["measurements"]):
            print(row(study["study"], m))
    missed = [(s["study"], check) for s in studies for check in s["checks"] if not check["met"]]
    for study, check in missed:
        print(f"MISSED: {study}: {check['what']}: {check['value']}, asked {check['allowed']}")


if __name__ == "__main__":
    main()
