#!/usr/bin/python3
"""Checks that every "NAME note 1.2" resolves: src/theory has a file titled "# NAME note ..." with a
heading of that number. Reports each violation as file:line, and fails if there is one.

A list of numbers belongs to one note ("RKPM notes 3.1, 4 and 8"). The files of src/theory may link
instead of using the word "note". A citation may extend over several lines of a comment.
"""

import argparse
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parents[1]
THEORY = pathlib.Path("src/theory")
PLACES = ["include", "src", "tests", "inputs", "tools", ".github", "README.md"]
SUFFIXES = {".hpp", ".cpp", ".py", ".toml", ".json", ".md", ".txt", ""}

NUMBER = r"\d+(?:\.\d+)*"
NUMBERS = rf"{NUMBER}(?:(?:, | and |, and | to ){NUMBER})*"
LINE_OF_COMMENT = re.compile(r"\n[ \t]*(?://+|#+(?= ))?[ \t]*")


def read_theory():
    """Numbers of the headings by name of the note in lower case, and the name of each file."""
    headings, name_of = {}, {}
    for path in sorted((ROOT / THEORY).glob("*.md")):
        text = path.read_text()
        title = re.match(r"# (.+?) note\b", text)
        if not title:
            continue
        name = name_of[path.name] = title.group(1).lower()
        headings[name] = re.findall(rf"^#{{2,4}} ({NUMBER})\b", text, re.MULTILINE)
    return headings, name_of


def files():
    for place in PLACES:
        path = ROOT / place
        for file in sorted(path.rglob("*")) if path.is_dir() else [path]:
            if file.is_file() and file.suffix in SUFFIXES and file.name != "check_notes.py":
                yield file


def citations(text, names, in_theory):
    """Triples (position, name or None, numbers) of the citations in a text on one line."""
    word = r"(?: notes?)?" if in_theory else r" notes?"
    known = "|".join(sorted(map(re.escape, names), key=len, reverse=True))
    found = re.compile(rf"\b({known}){word} ({NUMBERS})\b", re.IGNORECASE)
    taken = set()
    for match in found.finditer(text):
        taken.add(match.end())
        yield match.start(), match.group(1).lower(), re.findall(NUMBER, match.group(2))
    for match in re.finditer(rf"(?<![\w-])notes? ({NUMBERS})\b", text):
        if match.end() not in taken:
            yield match.start(), None, [match.group(1)]


def check_file(path, headings, name_of, report):
    text = path.read_text(errors="replace")
    in_theory = path.parent == ROOT / THEORY
    if in_theory:  # [RKPM note](rkpm.md) 5.4 means RKPM 5.4
        for match in re.finditer(r"\]\((\w+\.md)\)", text):
            if not (path.parent / match.group(1)).is_file():
                report(path, text, match.start(), f"there is no file {match.group(1)}")
        text = re.sub(
            r"\[[^\]]*\]\((\w+\.md)\)", lambda m: name_of.get(m.group(1), m.group(1)), text
        )
    one_line = LINE_OF_COMMENT.sub(lambda m: " ".ljust(len(m.group())), text)
    one_line = re.sub(r" {2,}", lambda m: " " + "\0" * (len(m.group()) - 1), one_line)
    place = [i for i, c in enumerate(one_line) if c != "\0"]
    for at, name, numbers in citations(one_line.replace("\0", ""), headings, in_theory):
        for number in numbers:
            if name is None:
                report(path, text, place[at], f"note {number} of which file of {THEORY}?")
            elif number not in headings[name]:
                report(path, text, place[at], f"the {name} note has no section {number}")


def main():
    headings, name_of = read_theory()
    problems = []

    def report(path, text, position, what):
        line = text.count("\n", 0, position) + 1
        problems.append(f"{path.relative_to(ROOT)}:{line}: {what}")

    for name, numbers in headings.items():
        for number in {n for n in numbers if numbers.count(n) > 1}:
            problems.append(f"{THEORY}: the {name} note has two sections {number}")
    cited = list(files())
    for path in cited:
        check_file(path, headings, name_of, report)
    sections = sum(map(len, headings.values()))
    print("\n".join(problems) or f"{len(headings)} notes, {sections} sections: all cited ones exist")
    return 1 if problems else 0


if __name__ == "__main__":
    argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    ).parse_args()
    sys.exit(main())
