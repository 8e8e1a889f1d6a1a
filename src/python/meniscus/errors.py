# SPDX-License-Identifier: BSD-3-Clause
"""The exceptions of a run. Their messages are those of the program."""


class Error(Exception):
    """Any of the errors below."""


class InputError(Error, ValueError):
    """The scene or an argument is wrong. The message has one line per problem: place, key, value that was
    found, and values that are allowed."""


class SolveError(Error, RuntimeError):
    """The calculation cannot go on. The message names step, body, particle and cause."""


class FileError(Error, OSError):
    """A file cannot be read or written, or was written by another scene."""
