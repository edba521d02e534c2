"""The parts of a representation as one value."""

from __future__ import annotations

from dataclasses import fields

from graphface.nodes.representation.bundle import bundle
from graphface.nodes.types import Representation


class TestBundle:
    def test_every_part_is_in_its_place(self):
        """Each port becomes the field of its name."""
        parts = {field.name: object() for field in fields(Representation)}
        made = bundle(**parts)
        assert all(getattr(made, name) is part for name, part in parts.items())
