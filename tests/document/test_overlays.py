"""Variants, profiles and flags: partial nodes laid over those of files."""

from collections.abc import Callable
from pathlib import Path

import pytest
from graph_texts import ADD, refused

from graphface import Graph

Write = Callable[..., Path]


class TestOverlays:
    TEXT = (
        ADD
        + "variants:\n  more: {x: {with: {plus: 10}}}\n  less: {x: {use: toy.subtract}}\n  none: {x: null}\n"
        + "profiles:\n  draft: {x: {plus: 100}}\n  odd: {n: {value: 7}, x: {plus: 200}}\n"
    )

    @pytest.fixture
    def path(self, write: Write) -> Path:
        return write("g.yaml", self.TEXT)

    def test_variant(self, path: Path, opened: Callable[..., Graph]) -> None:
        """A variant changes what it names."""
        assert opened(path, variants=["more"]).run()["y"] == 11

    def test_later_variant_wins(self, path: Path, opened: Callable[..., Graph]) -> None:
        """Of several, the later wins, and what they do not both say adds up."""
        assert opened(path, profiles=["odd", "draft"]).run()["y"] == 107
        assert opened(path, profiles=["draft", "odd"]).run()["y"] == 207

    def test_operator_of_a_variant(self, path: Path, opened: Callable[..., Graph]) -> None:
        """A variant may exchange the operator; parameters that the new one does not know are dropped."""
        assert opened(path, variants=["less"]).run()["y"] == 1

    def test_set_of_a_dropped_parameter(self, path: Path, opened: Callable[..., Graph]) -> None:
        """But a parameter set by hand for the new operator is never dropped silently."""
        (problem,) = refused(opened, path, variants=["less"], set={"x.plus": 3})
        assert "'plus'" in problem.message
        assert problem.place is not None
        assert problem.place.source.name == "--set"

    def test_removed_node(self, path: Path, opened: Callable[..., Graph]) -> None:
        """What needs a node that a variant removed says so."""
        (problem,) = refused(opened, path, variants=["none"])
        assert "'x'" in problem.message

    @pytest.mark.parametrize(
        ("choice", "nearest"),
        [({"variants": ["mor"]}, "more"), ({"profiles": ["drat"]}, "draft")],
        ids=["variant", "profile"],
    )
    def test_unknown(self, path: Path, opened: Callable[..., Graph], choice: dict[str, object], nearest: str) -> None:
        """An unknown variant or profile is told the nearest."""
        (problem,) = refused(opened, path, **choice)
        assert problem.nearest == (nearest,)

    @pytest.mark.parametrize(
        ("choice", "flag"),
        [({"set": {"xx.plus": 1}}, "--set"), ({"replace": {"xx": "toy.add"}}, "--replace")],
        ids=["set", "replace"],
    )
    def test_unknown_node(self, path: Path, opened: Callable[..., Graph], choice: dict[str, object], flag: str) -> None:
        """A flag for a node that does not exist is told the nearest, and its place is the flag."""
        (problem,) = refused(opened, path, **choice)
        assert problem.nearest == ("x",)
        assert problem.place is not None
        assert problem.place.source.name == flag

    def test_unknown_inner_node(self, write: Write, opened: Callable[..., Graph]) -> None:
        """Inside a used graph the nearest is told by its path."""
        write("inner.yaml", ADD)
        path = write("o.yaml", "nodes: {face: {use: inner.yaml}}\n")
        (problem,) = refused(opened, path, set={"face/xx.plus": 1})
        assert problem.nearest[0] == "face/x"

    def test_replace(self, path: Path, opened: Callable[..., Graph]) -> None:
        """`--replace` exchanges an operator and keeps its wires."""
        assert opened(path, replace={"x": "toy.slow"}).run()["y"] == 1
