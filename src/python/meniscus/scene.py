# SPDX-License-Identifier: BSD-3-Clause
"""Scenes as dictionaries of Python, written as TOML."""

import json
import math
import numbers
import os
import re
from collections.abc import Mapping
from typing import Any

import numpy as np

__all__ = ["to_toml"]


def to_toml(scene: Mapping[str, Any]) -> str:
    """The TOML text of a dictionary. Values are numbers, texts (also quantities with units such as "2 nm"),
    booleans, paths, dictionaries, and lists or numpy arrays of them. A list of dictionaries becomes an
    array of tables such as [[body]]. Raises TypeError, which names the key, for other values."""
    return "".join(_table(scene, "", ""))


def to_value(value: Any, place: str = "the value") -> str:
    """A value in one line of TOML; `place` names it in the TypeError for a value that TOML does not have."""
    value = _plain(value)
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, str):
        return _text(value)
    if isinstance(value, numbers.Integral):
        return str(int(value))
    if isinstance(value, numbers.Real):
        return _number(float(value))
    if isinstance(value, Mapping):
        return "{" + ", ".join(f"{_key(k, place)} = {to_value(v, f'{place}.{k}')}" for k, v in value.items()) + "}"
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(to_value(v, f"{place}[{i}]") for i, v in enumerate(value)) + "]"
    hint = "; leave out a key without a value" if value is None else ""
    raise TypeError(f"{place} is of type {type(value).__name__}; expected is a number, a text, a boolean, a "
                    f"dictionary, a list or a numpy array{hint}")


def _table(table, header, place):
    """The lines of a table: its values first, since a header ends the table, then its inner tables."""
    if not isinstance(table, Mapping):
        raise TypeError(f"{place or 'the scene'} is of type {type(table).__name__}; expected is a dictionary")
    inner = []
    for name, value in table.items():
        key, where = _key(name, place), f"{place}.{name}" if place else str(name)
        value = _plain(value)
        path = f"{header}.{key}" if header else key
        if isinstance(value, Mapping):
            inner.append((f"[{path}]", path, value, where))
        elif isinstance(value, (list, tuple)) and value and all(isinstance(v, Mapping) for v in value):
            inner += [(f"[[{path}]]", path, v, f"{where}[{i}]") for i, v in enumerate(value)]
        else:
            yield f"{key} = {to_value(value, where)}\n"
    for line, path, value, where in inner:
        yield f"\n{line}\n"
        yield from _table(value, path, where)


def _plain(value):
    if isinstance(value, (np.ndarray, np.generic)):
        return value.tolist()
    return os.fspath(value) if isinstance(value, os.PathLike) else value


def _key(name, place):
    if not isinstance(name, str):
        raise TypeError(f"{place or 'the scene'} has a key of type {type(name).__name__}; expected is a text")
    return name if re.fullmatch(r"[A-Za-z0-9_-]+", name) else _text(name)


def _text(text):
    return json.dumps(text, ensure_ascii=False).replace("\x7f", "\\u007f")  # the escapes of TOML


def _number(value):
    if math.isfinite(value):
        return repr(value)
    return "nan" if math.isnan(value) else "inf" if value > 0 else "-inf"
