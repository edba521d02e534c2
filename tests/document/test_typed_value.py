"""What a model says about the values of a tree: their names, keys and kinds."""

from __future__ import annotations

from typing import Annotated, Any, Literal

import pytest
from pydantic import BaseModel, Field

from graphface.document.located import parse
from graphface.document.typed_value import TypedValue, alternatives, holds_models, items
from graphface.place import Source


class Leaf(BaseModel):
    kind: Literal["leaf"] = "leaf"
    size: int = 0


class Tree(BaseModel):
    kind: Literal["tree"] = "tree"
    parts: list[Annotated[Leaf | Tree, Field(discriminator="kind")]] = []
    named: dict[str, Leaf] = {}


def top(text: str) -> TypedValue:
    tree, _ = parse(Source("t.yaml", text))
    return TypedValue(tree, tree.place, (Tree,))


class TestTypedValue:
    def test_names(self) -> None:
        """A value is called by the keys that lead to it; the whole by its model."""
        value = top("parts: [{size: 1}]\nnamed: {a: {size: 2}}")
        assert str(value) == "Tree"
        assert str(value.inside("parts").inside(0)) == "parts[0]"
        assert str(value.inside("parts").inside(0).as_member("leaf")) == "parts[0] (leaf)"
        assert str(value.inside("named").inside("a").inside("size")) == "named.a.size"

    def test_places(self) -> None:
        """Each knows where it stands."""
        assert str(top("parts: [{size: 1}]").inside("parts").inside(0).inside("size").place) == "t.yaml:1:16"
        assert str(top("parts: []").key_place("parts")) == "t.yaml:1:1"

    def test_entries(self) -> None:
        """What a mapping may hold depends on which member of a union it is."""
        part = top("parts: [{}]").inside("parts").inside(0)
        assert part.names == ["kind", "size", "parts", "named"]
        assert part.as_member("leaf").names == ["kind", "size"]
        assert part.as_member("Leaf").names == ["kind", "size"]

    def test_a_key_like_a_member(self) -> None:
        """Of what may be several things, the first name is that of a member, even if there is such a key."""
        part = top("parts: [{leaf: 1}]").inside("parts").inside(0)
        assert not part.holds("leaf")
        assert part.as_member("leaf").holds("leaf")

    def test_a_key_like_a_field(self) -> None:
        """Keys of a plain mapping are no fields."""
        value = top("named: {size: {size: 1}}").inside("named").inside("size")
        assert value.models == [Leaf]


class TestTypes:
    @pytest.mark.parametrize(
        ("annotation", "expected"),
        [
            (int, [int]),
            (int | None, [int]),
            (int | Annotated[str | None, "x"], [int, str]),
            (Annotated[list[int], "x"] | int, [list[int], int]),
        ],
    )
    def test_alternatives(self, annotation: Any, expected: list[Any]) -> None:
        """The members of unions at any depth; None needs no name."""
        assert alternatives(annotation) == expected

    @pytest.mark.parametrize(
        ("annotation", "expected"),
        [
            (int, []),
            (list[int | str], [int, str]),
            (tuple[int, ...], [int]),
            (tuple[int, str], [int, str]),
            (dict[str, int], [int]),
        ],
    )
    def test_items(self, annotation: Any, expected: list[Any]) -> None:
        """What lists hold, and mappings under their keys."""
        assert items(annotation) == expected

    def test_holds_models(self) -> None:
        """Models are found at any depth."""
        assert holds_models(dict[str, list[Leaf] | None])
        assert not holds_models(tuple[int, ...])
