# SPDX-License-Identifier: BSD-3-Clause
"""From keyword arguments to the JSON that the library's parameters are read from."""

import json
import math
import operator
import reprlib
from collections.abc import Mapping

import numpy as np


def plain(value):
    """The value as Python's own numbers, texts, lists and dictionaries; what is not a
    finite number is none."""
    if isinstance(value, dict):
        return {str(key): plain(item) for key, item in value.items()}
    if isinstance(value, np.ndarray) or hasattr(value, "tolist"):
        return plain(value.tolist())
    if isinstance(value, (list, tuple, range, set, frozenset)):
        return [plain(item) for item in value]
    if isinstance(value, float) and not math.isfinite(value):
        return None
    if isinstance(value, (bool, int, float, str)) or value is None:
        return value
    raise ValueError(f"A parameter is {value!r}: it must be a number, a text, or a list of these.")


def to_json(parameters):
    """The JSON of a dictionary of parameters."""
    return json.dumps(plain(parameters))


def numbers(values, what):
    """One number or several as a list of finite ones."""
    array = np.atleast_1d(np.asarray(values))
    if array.dtype.kind not in "iufb" or array.ndim != 1 or not np.isfinite(array).all():
        raise ValueError(f"{what} is {values!r}: it must be a finite number, or several.")
    return [float(value) for value in array]


def number(value, what):
    """One finite number."""
    found = numbers(value, what)
    if len(found) != 1:
        raise ValueError(f"{what} is {value!r}: it must be one number.")
    return found[0]


def mapping(value, what, of="parameters"):
    """A dictionary; an empty one for None."""
    if value is None:
        return {}
    if not isinstance(value, Mapping) and not hasattr(value, "keys"):
        raise TypeError(f"{what} is {reprlib.repr(value)}: it must be a dictionary, of names to {of}.")
    return {name: value[name] for name in value.keys()}


def scale(value):
    """Factors per axis; None for "auto"."""
    if isinstance(value, str):
        if value != "auto":
            raise ValueError(f"scale is {value!r}: it must be three factors, or 'auto'.")
        return None
    factors = numbers(value, "scale")
    if len(factors) != 3:
        raise ValueError(f"scale has {len(factors)} factors: there must be three, one for each axis.")
    return factors


def count(value, what):
    """A whole number from 0."""
    try:
        number = operator.index(value)
    except TypeError:
        raise TypeError(f"{what} is {value!r}: it must be a whole number from 0.") from None
    if not 0 <= number < 2**31:
        raise ValueError(f"{what} is {value!r}: it must be a whole number from 0.")
    return number


def from_json(text):
    """The dictionary of the library's parameters; what is not given is None."""
    return json.loads(text)
