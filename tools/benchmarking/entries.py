# SPDX-License-Identifier: BSD-3-Clause
"""The benchmarks of inputs/benchmarks/published.toml."""

import pathlib
import tomllib

FOLDER = pathlib.Path(__file__).resolve().parents[2] / "inputs" / "benchmarks"
KEYS = {"name", "field", "title", "source", "reason", "note", "short", "results", "case", "pulsation", "curve", "converge",
        "picture"}  # fmt: skip
CASE_KEYS = {"name", "set", "others", "explained"}


def require_known(table, known, where):
    for key in table:
        if key not in known:
            raise ValueError(f"published.toml: '{key}' of {where} is none of {', '.join(sorted(known))}")


def read(path=FOLDER / "published.toml"):
    """All benchmarks. Those without a `reason` have a scene of their name; `case` is a list with at least one case.
    Raises OSError or ValueError."""
    benchmarks = tomllib.loads(path.read_text(encoding="utf-8"))["benchmark"]
    for entry in benchmarks:
        require_known(entry, KEYS, f"'{entry['name']}'")
        entry.setdefault("case", [{"name": ""}])
        for case in entry["case"]:
            require_known(case, CASE_KEYS, f"a case of '{entry['name']}'")
        scene = FOLDER / f"{entry['name']}.toml"
        if scene.is_file() == ("reason" in entry):
            raise ValueError(f"published.toml: '{entry['name']}' has both a scene and a reason, or neither")
        entry["scene"] = scene
    return benchmarks


def chosen(benchmarks, field, names, short):
    """The benchmarks of a field, or with one of these names; in the short form each with its one short case.
    Raises ValueError if there are none."""
    fields = list(dict.fromkeys(entry["field"] for entry in benchmarks))
    if field and field not in fields:
        raise ValueError(f"there is no field '{field}'; there are {', '.join(fields)}")
    for name in names or ():
        if name not in [entry["name"] for entry in benchmarks]:
            raise ValueError(f"published.toml has no benchmark '{name}'")
    some = [e for e in benchmarks if field in (None, e["field"]) and (not names or e["name"] in names)]
    if short:
        some = [shortened(entry) for entry in some if "short" in entry]
    if not some:
        raise ValueError("no benchmark is chosen")
    return some


def shortened(entry):
    """The benchmark with the case of its short form alone, whose keys are added."""
    wanted = entry["short"].get("case", entry["case"][0]["name"])
    case = next(c for c in entry["case"] if c["name"] == wanted)
    return {**entry, "case": [{**case, "set": {**case.get("set", {}), **entry["short"].get("set", {})}}]}
