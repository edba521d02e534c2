"""Plain YAML scalars as values."""

from __future__ import annotations

import math
import re
from typing import Any

MAX_DIGITS = 1000

_INT = re.compile(r"[-+]?[0-9]+")
_HEX = re.compile(r"0x[0-9a-fA-F]+")
_OCTAL = re.compile(r"0o[0-7]+")
_FLOAT = re.compile(r"[-+]?(\.[0-9]+|[0-9]+(\.[0-9]*)?)([eE][-+]?[0-9]+)?")
_CONSTANTS: dict[str, Any] = {
    **dict.fromkeys(("", "~", "null", "Null", "NULL")),
    **dict.fromkeys(("true", "True", "TRUE"), True),
    **dict.fromkeys(("false", "False", "FALSE"), False),
    **dict.fromkeys((".inf", ".Inf", ".INF", "+.inf"), math.inf),
    "-.inf": -math.inf,
    **dict.fromkeys((".nan", ".NaN", ".NAN"), math.nan),
}


def scalar(text: str) -> Any:
    """A plain scalar by YAML 1.2's core schema: null, bool, int, float or str.

    An integer of more than `MAX_DIGITS` digits is infinite: Python refuses to convert or even print such numbers.
    """
    if text in _CONSTANTS:
        return _CONSTANTS[text]
    for form, base in ((_INT, 10), (_HEX, 16), (_OCTAL, 8)):
        if form.fullmatch(text):
            return int(text, base) if len(text) <= MAX_DIGITS else math.inf
    return float(text) if _FLOAT.fullmatch(text) else text
