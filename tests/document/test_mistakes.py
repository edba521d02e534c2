"""All mistakes of a tree at once, each where it stands, with the names that may be meant."""

from __future__ import annotations

from typing import Annotated, Any, Literal

import pytest
from hypothesis import given
from hypothesis import strategies as st
from pydantic import BaseModel, ConfigDict, Field, ValidationError, model_validator

from graphface.document.located import parse
from graphface.document.mistakes import mistakes
from graphface.errors import Problem
from graphface.place import Source


class Part(BaseModel):
    model_config = ConfigDict(extra="forbid", allow_inf_nan=False)


class Circle(Part):
    kind: Literal["circle"]
    radius: Annotated[float, Field(ge=0, le=10)] = 1.0
    diameter: Annotated[float, Field(ge=0, le=20)] | None = None

    @model_validator(mode="after")
    def _one_size(self) -> Circle:
        if self.diameter is not None and "radius" in self.model_fields_set:
            raise ValueError("give either a radius or a diameter")
        return self


class Box(Part):
    kind: Literal["box"]
    size: tuple[float, float] = (1.0, 1.0)
    fill: Literal["none", "solid", "dotted"] = "solid"
    inside: Box | None = None


class Layer(Part):
    order: int


class Drawing(Part):
    title: str = ""
    shapes: tuple[Annotated[Circle | Box, Field(discriminator="kind")], ...] = ()
    margin: float | tuple[float, float] = 0.0
    layers: dict[str, Layer] = {}
    visible: bool = True
    given_name: str = Field("", alias="name")


WORDS = st.sampled_from(
    ["kind", "circle", "box", "shapes", "radius", "size", "margin", "layers", "order", "inside", "fill", "x", "name"]
)
TREES = st.recursive(
    st.none() | st.booleans() | st.floats() | st.integers() | WORDS,
    lambda inner: st.lists(inner, max_size=3) | st.dictionaries(WORDS, inner, max_size=4),
    max_leaves=12,
)


def found(text: str) -> list[Problem]:
    source = Source("d.yaml", text)
    tree, twice = parse(source)
    assert not twice
    return mistakes(tree, Drawing)


def told(text: str) -> list[tuple[str, str]]:
    """Each mistake as the text under the caret and the sentence."""
    sentences = []
    for problem in found(text):
        assert problem.place is not None
        line = text.split("\n")[problem.place.line - 1]
        sentences.append((line[problem.place.column - 1 :], problem.message))
    return sentences


class TestOne:
    def test_valid(self) -> None:
        """A valid tree has none."""
        assert found("title: T\nmargin: [1, 2]\nshapes: [{kind: box, size: [1, 2]}]\nname: n\n") == []

    def test_unknown_key(self) -> None:
        """An unknown key is shown itself, with what there is and what is nearest."""
        ((text, message),) = told("titel: T")
        assert text == "titel: T"
        assert message == "Drawing has no entry 'titel' (it has title, shapes, margin, layers, visible, name)"
        assert found("titel: T")[0].nearest == ("title",)

    def test_unknown_key_of_a_member(self) -> None:
        """In a union, the names are those of the member that is written."""
        ((text, message),) = told("shapes: [{kind: circle, raduis: 2}]")
        assert text == "raduis: 2}]"
        assert message == "shapes[0] (circle) has no entry 'raduis' (it has kind, radius, diameter)"

    @pytest.mark.parametrize(
        ("text", "shown", "words"),
        [
            ("shapes: [{kind: circle, radius: 11}]", "11}]", "[0].radius: input should be less than or equal to 10"),
            ("shapes: [{kind: circle, radius: .nan}]", ".nan}]", "finite number, got nan"),
            ("shapes: [{kind: circle, radius: big}]", "big}]", "shapes[0].radius: input should be a number, got 'big'"),
            ("shapes: [{kind: circle, diameter: [1]}]", "[1]}]", "input should be a number, got [1]"),
            ("shapes: [{kind: box, size: [1]}]", "[1]}]", "shapes[0].size: 2 values are needed, got [1]"),
            ("shapes: [{kind: box, size: []}]", "[]}]", "shapes[0].size: 2 values are needed, got []"),
            ("shapes: [{kind: box, size: [1, 2, 3]}]", "[1, 2, 3]}]", "at most 2 values fit, got [1, 2, 3]"),
            ("shapes: [{kind: box, size: [1, x]}]", "x]}]", "shapes[0].size[1]: input should be a number, got 'x'"),
            ("shapes: 3", "3", "shapes: input should be a list, got 3"),
            ("shapes: {kind: box}", "{kind: box}", "shapes: input should be a list, got {'kind': 'box'}"),
            ("shapes: [box]", "box]", "shapes[0]: input should be a mapping, got 'box'"),
            ("shapes:", "", "shapes: input should be a list, got nothing"),
            ("margin: wide", "wide", "margin: input should be a number or a list, got 'wide'"),
            ("margin: [1, x]", "x]", "margin[1]: input should be a number, got 'x'"),
            ("margin: [1]", "[1]", "margin: 2 values are needed, got [1]"),
            ("layers: {top: {order: 1.5}}", "1.5}}", "layers.top.order: input should be a whole number, got 1.5"),
            ("layers: {top: {}}", "{}}", "layers.top: 'order' is required"),
            ("layers: {top: 1}", "1}", "layers.top: input should be a mapping with order, got 1"),
            ("visible: maybe", "maybe", "visible: input should be true or false, got 'maybe'"),
            ("title: [T]", "[T]", "title: input should be a text, got ['T']"),
            ("- 1", "- 1", "Drawing: input should be a mapping with title, shapes,"),
        ],
    )  # fmt: skip
    def test_wrong_value(self, text: str, shown: str, words: str) -> None:
        """A wrong value is shown itself, named by the keys that lead to it, in the words of YAML."""
        ((at, message),) = told(text)
        assert at == shown
        assert words in message

    def test_choice(self) -> None:
        """A word that is none of the choices is told the nearest."""
        (problem,) = found("shapes: [{kind: box, fill: sloid}]")
        assert problem.nearest == ("solid",)
        assert "'none', 'solid' or 'dotted'" in problem.message

    def test_rule(self) -> None:
        """A rule between fields is told in its own words, at the mapping it is about."""
        ((text, message),) = told("shapes: [{kind: circle, radius: 1, diameter: 2}]")
        assert text.startswith("{kind")
        assert message == "shapes[0] (circle): give either a radius or a diameter"

    def test_alias(self) -> None:
        """Keys are those of the file, not of Python."""
        ((text, _),) = told("name: [1]")
        assert text == "[1]"
        assert found("nmae: n")[0].nearest == ("name",)

    def test_long_value(self) -> None:
        """A long value is not repeated in full."""
        assert len(found(f"visible: {'x' * 1000}")[0].message) < 200


class TestMember:
    def test_misspelt(self) -> None:
        """A wrong name of a member is shown itself, with those there are."""
        (problem,) = found("shapes: [{kind: circel}]")
        assert problem.place is not None
        assert problem.place.column == 17
        assert problem.message == "shapes[0]: unknown kind 'circel' (it is one of circle, box)"
        assert problem.nearest == ("circle",)

    @pytest.mark.parametrize("tag", ["null", "3", "[box]", "{a: 1}", "''"])
    def test_no_name(self, tag: str) -> None:
        """What is no name of a member at all is shown too."""
        ((text, message),) = told(f"shapes: [{{kind: {tag}}}]")
        assert text == f"{tag}}}]"
        assert "unknown kind" in message

    def test_missing(self) -> None:
        """Where none is said, the mapping is shown, and the members that have the keys written are the likely ones."""
        (problem,) = found("shapes: [{radius: 2}]")
        assert problem.place is not None
        assert problem.place.column == 10
        assert problem.message == "shapes[0] has no 'kind' (it is one of circle, box)"
        assert problem.nearest == ("circle",)
        assert found("shapes: [{}]")[0].nearest == ()

    def test_misspelt_key(self) -> None:
        """A misspelt key of the member's name is one mistake."""
        (problem,) = found("shapes: [{knid: box, size: [1, 2]}]")
        assert problem.place is not None
        assert problem.place.column == 11
        assert problem.nearest == ("kind",)


class TestAll:
    def test_at_once(self) -> None:
        """Every mistake is found in one reading, in the order of the text."""
        text = """\
shapes:
  - {kind: box, fill: stripes, sise: [1, 2]}
  - {kind: circle, radius: -1}
  - {kind: box, inside: {kind: box, inside: {kind: box, size: 3}}}
titel: T
margin: [1, 2, 3]
"""
        assert [text.split(":")[0] for text, _ in told(text)] == [
            "stripes, sise",
            "sise",
            "-1}",
            "3}}}",
            "titel",
            "[1, 2, 3]",
        ]

    def test_behind_a_wrong_member(self) -> None:
        """Of a member whose name is misspelt, the fields are checked too."""
        assert [text for text, _ in told("shapes: [{kind: circel, radius: 11, raduis: 1}]")] == [
            "circel, radius: 11, raduis: 1}]",
            "11, raduis: 1}]",
            "raduis: 1}]",
        ]

    @pytest.mark.parametrize("radius", ["11", "big", "[1]", ".inf"])
    def test_behind_wrong_fields(self, radius: str) -> None:
        """A rule between fields is asked even where one of them is wrong."""
        messages = [message for _, message in told(f"shapes: [{{kind: circle, radius: {radius}, diameter: 2}}]")]
        assert len(messages) == 2
        assert "give either" in messages[0]

    def test_no_rule_is_asked_of_nothing(self) -> None:
        """A wrong value never counts as not given."""
        assert len(found("shapes: [{kind: circle, diameter: big, radius: 1}]")) == 1

    def test_plain_data(self) -> None:
        """Plain data has the same mistakes, without places."""
        content: Any = {"shapes": ({"kind": "circel", "radius": 11},), "titel": 1}
        problems = mistakes(content, Drawing)
        assert [p.place for p in problems] == [None] * 3
        assert content == {"shapes": ({"kind": "circel", "radius": 11},), "titel": 1}

    def test_an_object(self) -> None:
        """A member that is an object already is taken as it is."""
        assert mistakes({"shapes": [Circle(kind="circle")]}, Drawing) == []


class TestAny:
    @given(TREES)
    def test_agrees_with_pydantic(self, tree: Any) -> None:
        """There is a mistake exactly where pydantic finds one."""
        try:
            Drawing.model_validate(tree)
            valid = True
        except ValidationError:
            valid = False
        assert (mistakes(tree, Drawing) == []) == valid

    @given(st.lists(TREES, max_size=3))
    def test_shapes(self, shapes: list[Any]) -> None:
        """So too inside a union."""
        tagged = [{"kind": "circle", **s} if isinstance(s, dict) else s for s in shapes]
        for tree in ({"shapes": shapes}, {"shapes": tagged}):
            try:
                Drawing.model_validate(tree)
                valid = True
            except ValidationError:
                valid = False
            assert (mistakes(tree, Drawing) == []) == valid
