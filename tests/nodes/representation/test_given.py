"""A saved representation in the place of a computed one."""

from __future__ import annotations

from graphface.nodes.representation.given import given
from graphface.nodes.types import Representation


class TestGiven:
    def test_is_passed_on(self):
        """The same object."""
        saved = object.__new__(Representation)
        assert given(saved) is saved
