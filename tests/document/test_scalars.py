"""Plain scalars follow YAML 1.2's core schema."""

from __future__ import annotations

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from graphface.document.scalars import scalar


class TestScalars:
    @pytest.mark.parametrize(
        ("text", "value"),
        [
            ("12", 12),
            ("-3", -3),
            ("+3", 3),
            ("0x1F", 31),
            ("0o17", 15),
            ("017", 17),
            ("1e0", 1.0),
            ("1.", 1.0),
            (".5", 0.5),
            ("-1.5E-3", -0.0015),
            ("true", True),
            ("False", False),
            ("~", None),
            ("", None),
            ("null", None),
            ("-.inf", -math.inf),
            ("on", "on"),
            ("yes", "yes"),
            ("1_000", "1_000"),
            ("1:30", "1:30"),
            ("2024-01-01", "2024-01-01"),
            ("١٢", "١٢"),
            ("1e999", math.inf),
        ],
    )
    def test_core_schema(self, text: str, value: object) -> None:
        """Plain scalars follow YAML 1.2's core schema: `on` is a word, `1e0` a number."""
        found = scalar(text)
        assert found == value
        assert type(found) is type(value)

    @pytest.mark.parametrize("text", ["9" * 5000, "-" + "9" * 5000, "0x" + "f" * 100_000, "0o" + "7" * 100_000])
    def test_huge_integer(self, text: str) -> None:
        """A number that Python would refuse to print is infinite."""
        assert scalar(text) == math.inf

    @given(st.text(max_size=20))
    def test_any_text(self, text: str) -> None:
        """Every text is some scalar."""
        assert isinstance(scalar(text), str | int | float | bool | None)

    @given(st.integers(-(10**30), 10**30) | st.floats(allow_nan=False, allow_infinity=False))
    def test_numbers_come_back(self, number: float) -> None:
        """What Python prints for a number is read as that number."""
        assert scalar(repr(number)) == number
