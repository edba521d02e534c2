"""A representation that was saved."""

from __future__ import annotations

from graphface import node
from graphface.nodes.types import Representation


@node("representation.given")
def given(saved: Representation) -> Representation:
    """A saved representation, in the place of the graph that computes one."""
    return saved
