"""YAML texts keep their positions, and no text, however hostile, is more than an error."""

import contextlib
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from graphface.document.located import MAX_DEPTH, Map, Seq, file_source, parse, place_inside
from graphface.errors import DocumentError, Problem, UnreadableFile
from graphface.place import Source


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


class TestKeysAndTexts:
    def test_quoted(self) -> None:
        """A quoted scalar is a text."""
        assert dict(read("a: '1'\nb: \"true\"\nc: |\n  3\n")) == {"a": "1", "b": "true", "c": "3\n"}

    def test_keys_are_texts(self) -> None:
        """Keys are words whatever they look like."""
        assert list(read("1: a\ntrue: b\nnull: c\n")) == ["1", "true", "null"]


class TestMerge:
    def test_entries_of_another_mapping(self) -> None:
        """`<<` stands for the entries of another mapping; those written here win, wherever they stand."""
        tree = read("a: &a {x: 1, y: 2}\nb: {y: 3, <<: *a}\nc: {<<: *a, y: 3}\n")
        assert dict(tree["b"]) == {"y": 3, "x": 1}
        assert dict(tree["c"]) == {"x": 1, "y": 3}

    def test_several(self) -> None:
        """Of several mappings the first wins."""
        tree = read("a: &a {x: 1}\nb: &b {x: 2, y: 2}\nc: {<<: [*a, *b]}\n")
        assert dict(tree["c"]) == {"x": 1, "y": 2}

    def test_places(self) -> None:
        """An entry stands where it is written."""
        tree = read("a: &a {x: 1}\nb: {<<: *a}\n")
        assert tree["b"].key_place("x").line == 1

    @pytest.mark.parametrize("text", ["a: {<<: 3}", "a: {<<: [3]}", "a: {<<: null}"])
    def test_no_mapping(self, text: str) -> None:
        """Anything else is a problem where it stands."""
        _, (problem,) = parse(Source("g", text))
        assert problem.place is not None
        assert problem.place.column == 5


class TestPlaceInside:
    def test_leads_inside(self) -> None:
        """Keys lead to the place of a value, names that are no keys are passed over."""
        tree = read("a: {b: [1, {c: 2}]}")
        found = place_inside(tree, ("a", "b", 1, "member", "c"))
        assert found is not None
        assert found.column == 16

    def test_nowhere(self) -> None:
        """What leads nowhere has no place."""
        assert place_inside(read("a: 1"), ("b", 0)) is None
        assert place_inside({"a": 1}, ("a",)) is None


class TestFileSource:
    def test_text(self, tmp_path: Path) -> None:
        """UTF-8, with or without a byte order mark."""
        for name, content in (("a", b"\xef\xbb\xbfa: 1"), ("b", b"a: 1")):
            (tmp_path / name).write_bytes(content)
            assert file_source(tmp_path / name).text == "a: 1"

    def test_not_text(self, tmp_path: Path) -> None:
        """The first byte that is no text is named."""
        (tmp_path / "a").write_bytes(b"a: \xff")
        with pytest.raises(UnreadableFile, match="byte 3 is 0xff"):
            file_source(tmp_path / "a")

    def test_size(self, tmp_path: Path) -> None:
        """A file larger than allowed is not read."""
        (tmp_path / "a").write_bytes(b"a" * 2049)
        assert len(file_source(tmp_path / "a", 2049).text) == 2049
        with pytest.raises(UnreadableFile, match="larger than 2 KiB"):
            file_source(tmp_path / "a", 2048)

    @pytest.mark.parametrize("name", ["none.yaml", "", "a\0b", "x" * 5000])
    def test_no_file(self, tmp_path: Path, name: str) -> None:
        """What is no file is said, whatever its name."""
        with pytest.raises(UnreadableFile):
            file_source(tmp_path / name)


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

    @pytest.mark.parametrize("text", ["\ta: 1", "a:\n\tb: 1", "a:\n  \tb: 1\n"])
    def test_tab(self, text: str) -> None:
        """A tab, which looks like spaces, is named."""
        assert "tab" in refusal(text).message

    def test_empty(self) -> None:
        """An empty text is a tree of nothing."""
        assert parse(Source("g", "")) == (None, [])

    @given(st.text(alphabet="ab:{}[]&*!?-|>'\"#%@, \n\t0\\\x00\ud800", max_size=60))
    def test_any_text(self, text: str) -> None:
        """Any text is a tree or a `DocumentError`."""
        with contextlib.suppress(DocumentError):
            parse(Source("g", text))
