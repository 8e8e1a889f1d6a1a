#!/usr/bin/python3
"""Checks who includes whom, reports each violation as file:line, and fails if there is one.

- A file includes headers of its own layer and of the layers in MAY_INCLUDE only.
- src/materials and src/contact are leaves of physics: sources without headers.
- Each library of CONFINED is included in one source file (or those of its pattern) only.
- Every header of the project that is named exists, and headers do not include each other in a
  cycle.
"""

import os
import pathlib
import re
import sys

MAY_INCLUDE = {
    "core": [],
    "approx": ["core"],
    "body": ["core", "approx"],
    "physics": ["core", "approx", "body"],
    "solve": ["core", "approx", "body", "physics"],
    "io": ["core"],
    "scene": ["core", "approx", "body", "physics", "solve", "io"],
    "app": ["core", "approx", "body", "physics", "solve", "io", "scene"],
}
LEAVES = {"materials": "physics", "contact": "physics"}

# Library: (beginning of its headers' names, files that may include it; None: any one source).
CONFINED = {
    "toml++": (r"toml\+\+/|toml\.hpp", None),
    "muParser": (r"muParser", None),
    "nanoflann": (r"nanoflann", None),
    "CLI11": (r"CLI/", None),
    "spdlog": (r"spdlog/", None),
    "HDF5": (r"hdf5|H5", "src/io/hdf5*.cpp"),
}

ROOT = pathlib.Path(__file__).resolve().parents[1]
INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]')


def layer_of(path):
    """Layer of a file in include/meniscus/<layer>/ or src/<layer>/; None if it is in none."""
    if path.parts[0] == "src":
        layer = LEAVES.get(path.parts[1], path.parts[1])
    else:
        layer = path.parts[2] if len(path.parts) > 3 else None
    return layer if layer in MAY_INCLUDE else None


def includes(path):
    """Pairs (line number, delimiter, name) of the include lines of a file."""
    for number, line in enumerate((ROOT / path).read_text().splitlines(), 1):
        if match := INCLUDE.match(line):
            yield number, *match.groups()


def resolve(path, delimiter, name):
    """The project file an include line means; None for a header of a library."""
    if not name.startswith("meniscus/") and delimiter == "<":
        return None
    folders = [pathlib.Path("include"), path.parent]
    if path.parts[0] == "tests":
        folders.append(pathlib.Path("tests"))
    files = [pathlib.Path(os.path.normpath(folder / name)) for folder in folders]
    return next((file for file in files if (ROOT / file).is_file()), files[0])


def check_file(path, graph, users, report):
    """Checks one file by itself; notes its includes in `graph` and its libraries in `users`."""
    product = path.parts[0] != "tests"
    if product:
        layer = layer_of(path)
        if layer is None:
            report(path, 1, f"is in none of the layers {', '.join(MAY_INCLUDE)}")
            return
        if path.parts[0] == "src" and path.parts[1] in LEAVES and path.suffix != ".cpp":
            report(path, 1, f"src/{path.parts[1]} has sources only, no header")
    for line, delimiter, name in includes(path):
        target = resolve(path, delimiter, name)
        if target is None:
            for library, (pattern, _) in CONFINED.items():
                if product and re.match(pattern, name):
                    users[library].append((path, line))
        elif not (ROOT / target).is_file():
            report(path, line, f"there is no header {name}")
        else:
            graph.setdefault(path, []).append((line, target))
            other = layer_of(target) if product else None
            if other and other != layer and other not in MAY_INCLUDE[layer]:
                report(path, line, f"{layer} must not include {other} ({name})")


def check_libraries(users, report):
    """Each library in sources only, and in no more than its own."""
    for library, uses in users.items():
        pattern = CONFINED[library][1]
        home = next((path for path, _ in uses if path.suffix == ".cpp"), None)
        for path, line in uses:
            if path.suffix != ".cpp":
                report(path, line, f"{library} must not be included in a header")
            elif pattern and not path.match(pattern):
                report(path, line, f"{library} belongs into {pattern}")
            elif not pattern and path != home:
                report(path, line, f"{library} is already included in {home}")


def check_cycles(graph, report):
    """Depth-first search; an include of a file that is still open closes a cycle."""
    done, trail = set(), []

    def visit(path):
        trail.append(path)
        for line, target in graph.get(path, []):
            if target in trail:
                cycle = [*trail[trail.index(target) :], target]
                report(path, line, "cycle " + " -> ".join(str(file) for file in cycle))
            elif target not in done:
                visit(target)
        done.add(trail.pop())

    for path in graph:
        if path not in done:
            visit(path)


def main():
    problems, graph, users = [], {}, {library: [] for library in CONFINED}

    def report(path, line, what):
        problems.append(f"{path}:{line}: {what}")

    for path in sorted(
        file.relative_to(ROOT)
        for folder in ("include", "src", "tests")
        for file in (ROOT / folder).rglob("*.[ch]pp")
    ):
        check_file(path, graph, users, report)
    check_libraries(users, report)
    check_cycles(graph, report)
    print("\n".join(problems) or f"{len(graph)} files that include others: no violation")
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
