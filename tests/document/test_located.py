"""YAML texts keep their positions, and no text, however hostile, is more than an error."""

import contextlib
import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from graphface.document.located import MAX_DEPTH, Map, Seq, parse
from graphface.document.scalars import scalar
from graphface.errors import DocumentError, Problem
from graphface.place import Place, Source


def read(text: str) -> Map:
    tree, problems = parse(Source("graph.yaml", text))
    assert problems == []
    return tree  # type: ignore[no-any-return]


def refusal(text: str) -> Problem:
    with pytest.raises(DocumentError) as caught:
        parse(Source("graph.yaml", text))
    (problem,) = caught.value.problems
    return problem


class TestPositions:
    def test_key_and_value(self) -> None:
        """A mapping knows where each key and each value stood, counted from 1."""
        tree = read("a: 1\nbc:   two\n")
        assert (tree.key_place("bc").line, tree.key_place("bc").column) == (2, 1)
        assert (tree.value_place("bc").line, tree.value_place("bc").column) == (2, 7)

    def test_nested(self) -> None:
        """Positions hold inside flow and block collections."""
        tree = read("a: {b: [x, yy,\n   z]}\n")
        items = tree["a"]["b"]
        assert isinstance(items, Seq)
        assert [(items.item_place(i).line, items.item_place(i).column) for i in range(3)] == [(1, 9), (1, 12), (2, 4)]

    def test_after_wide_characters(self) -> None:
        """A column counts characters, not bytes."""
        assert read("é日😀: 1").value_place("é日😀").column == 6

    def test_alias(self) -> None:
        """An aliased value stands where the alias does."""
        tree = read("a: &x {k: 1}\nb: *x\n")
        assert tree["b"] is tree["a"]
        assert tree.value_place("b").line == 2

    @given(st.lists(st.from_regex(r"[a-z]{1,8}", fullmatch=True), min_size=1, max_size=20, unique=True))
    def test_every_key_is_where_it_says(self, keys: list[str]) -> None:
        """The text at a key's place begins with the key."""
        source = Source("g", "".join(f"{' ' * 0}{key}: {{sub: {i}}}\n" for i, key in enumerate(keys)))
        tree, _ = parse(source)
        for key in tree:
            place = tree.key_place(key)
            assert source.lines[place.line - 1][place.column - 1 :].startswith(key)
            inner = tree[key].key_place("sub")
            assert source.lines[inner.line - 1][inner.column - 1 :].startswith("sub")


class TestExcerpt:
    def caret(self, line: str, column: int) -> tuple[str, str]:
        """The excerpt's line, and the character above the caret."""
        shown, pointer = Place(Source("g", line), 1, column).excerpt.split("\n")
        return shown, shown[pointer.index("^")]

    def test_caret(self) -> None:
        """The caret stands under the column."""
        assert self.caret("abc: def", 6)[1] == "d"

    def test_tab(self) -> None:
        """A tab takes one column."""
        assert self.caret("\tabc", 2)[1] == "a"

    def test_long_line(self) -> None:
        """Of a long line the part around the caret is shown."""
        shown, above = self.caret("x" * 500 + "Y" + "x" * 500, 501)
        assert above == "Y"
        assert len(shown) < 200

    def test_control_characters(self) -> None:
        """What would move the cursor is not printed."""
        assert "\x1b" not in Place(Source("g", "\x1b[2Jabc"), 1, 1).excerpt

    def test_outside(self) -> None:
        """A place behind the end of the text has no excerpt."""
        assert Place(Source("g", "a"), 7, 1).excerpt == ""

    def test_str(self) -> None:
        """A place reads as compilers write it."""
        assert str(Place(Source("g.yaml", "a"), 3, 4)) == "g.yaml:3:4"


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

    def test_quoted(self) -> None:
        """A quoted scalar is a text."""
        assert dict(read("a: '1'\nb: \"true\"\nc: |\n  3\n")) == {"a": "1", "b": "true", "c": "3\n"}

    def test_keys_are_texts(self) -> None:
        """Keys are words whatever they look like."""
        assert list(read("1: a\ntrue: b\nnull: c\n")) == ["1", "true", "null"]

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


class TestRefused:
    def test_duplicate_key(self) -> None:
        """A key that stands twice is a problem at its second place, which tells the first."""
        _, (problem,) = parse(Source("g", "a: 1\nb: 2\na: 3\n"))
        assert problem.place is not None
        assert problem.place.line == 3
        assert "line 1" in problem.message

    def test_first_of_a_duplicate_counts(self) -> None:
        """The tree holds the first."""
        tree, _ = parse(Source("g", "a: 1\na: 3\n"))
        assert tree["a"] == 1

    @pytest.mark.parametrize("text", ["a: !!python/object:os.system x", "a: !local 1", "a: !!map {}", "a: !!seq []"])
    def test_tag(self, text: str) -> None:
        """A tag is refused at its place, whatever it names."""
        place = refusal(text).place
        assert place is not None
        assert (place.line, place.column) == (1, 4)

    @pytest.mark.parametrize("text", ["? [a]\n: b", "? {a: 1}\n: b", "a: &x k\n*x : 1"])
    def test_key_is_no_word(self, text: str) -> None:
        """A key must be a plain word."""
        assert "plain word" in refusal(text).message

    def test_depth(self) -> None:
        """Nesting is bounded, and exactly the bound still works."""
        read("a: " + "[" * (MAX_DEPTH - 1) + "]" * (MAX_DEPTH - 1))
        assert str(MAX_DEPTH) in refusal("a: " + "[" * MAX_DEPTH + "]" * MAX_DEPTH).message

    def test_very_deep(self) -> None:
        """A hundred thousand brackets are an error, not a crash."""
        refusal("[" * 100_000)

    def test_alias_bomb(self) -> None:
        """Aliases that expand to more than a graph could need are refused."""
        lines = ["a0: &a0 [x, x, x, x, x, x, x, x, x, x]"]
        lines += [f"a{i}: &a{i} [{', '.join([f'*a{i - 1}'] * 10)}]" for i in range(1, 12)]
        assert "aliases expand" in refusal("\n".join(lines)).message

    def test_deep_aliases(self) -> None:
        """Nesting is bounded through aliases too: what walks a value later may recurse."""
        lines = ["a0: &a0 [x]"]
        lines += [f"a{i}: &a{i} {'[' * 30}*a{i - 1}{']' * 30}" for i in range(1, 50)]
        assert "deeper" in refusal("\n".join(lines)).message

    def test_self_alias(self) -> None:
        """An anchor cannot contain itself."""
        assert "'x'" in refusal("a: &x [*x]").message

    def test_unknown_anchor(self) -> None:
        """An alias needs its anchor before it."""
        assert "'y'" in refusal("a: *y").message

    def test_two_documents(self) -> None:
        """A graph file is one YAML document."""
        assert "one YAML document" in refusal("a: 1\n---\nb: 2\n").message

    @pytest.mark.parametrize(
        "text", ["a: [1", "a: 'x", "a: b: c", "\tx", "a: \x07", "- a\nb: 1", "a: \ud800", "%YAML 3.0\n---\n"]
    )
    def test_not_yaml(self, text: str) -> None:
        """A syntax error has a place and one line."""
        problem = refusal(text)
        assert problem.place is not None
        assert "\n" not in problem.message

    def test_empty(self) -> None:
        """An empty text is a tree of nothing."""
        assert parse(Source("g", "")) == (None, [])

    @given(st.text(alphabet="ab:{}[]&*!?-|>'\"#%@, \n\t0\\\x00\ud800", max_size=60))
    def test_any_text(self, text: str) -> None:
        """Any text is a tree or a `DocumentError`."""
        with contextlib.suppress(DocumentError):
            parse(Source("g", text))
