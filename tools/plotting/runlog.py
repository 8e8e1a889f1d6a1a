# SPDX-License-Identifier: BSD-3-Clause
"""What a run has said: its run.log."""

import collections
import re

import package  # noqa: F401  pylint: disable=unused-import

from meniscus import results as reader  # isort: skip


class Log:
    """run.log: what was said, by kind. A run that was continued says more than once how it begins."""

    LINE = re.compile(r"^\S+Z (info|warning|error): (.*)$")
    EXPECTED = re.compile(r"^(\S+) +(\S+) +(\S+) +(\S+)  (met|MISSED|not reached|reported)$")

    def __init__(self, path):
        said = []
        for line in reader.text_of(path).splitlines():
            if match := self.LINE.match(line):
                said.append(match.groups())
            elif said:  # a message of several lines
                said[-1] = (said[-1][0], f"{said[-1][1]}\n{line}")

        def texts(kind):
            return [text for level, text in said if level == kind]

        self.warnings = collections.Counter(texts("warning"))
        self.errors = texts("error")
        self.calls = [t for t in texts("info") if re.match(r"meniscus \d", t)]
        self.ends = [t for t in texts("info") if re.match(r"\d+ steps in ", t)]
        # Only the last run in the log describes the present files.
        last = max((k for k, (_, t) in enumerate(said) if re.match(r"meniscus \d", t)), default=0)
        now = [t for level, t in said[last:] if level == "info"]
        self.expected = [m.groups() for t in now if (m := self.EXPECTED.match(t))]
        skip = re.compile(
            r"meniscus \d|expectation +obtained|\d+ warnings?:$|  |step \d+, t = |\d+ steps in "
        )
        self.decided = [t for t in now if not skip.match(t) and not self.EXPECTED.match(t)]
