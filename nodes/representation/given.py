"""A representation read from a file."""

from __future__ import annotations

from graphface import node
from graphface.nodes.types import (
    Representation,
)


@node("representation.given")
def given(saved: Representation) -> Representation:
    """A representation from elsewhere, in the place of the graph that computes one."""
    return saved
