"""A place says where it is, and shows it."""

from __future__ import annotations

from graphface.place import Place, Source


class TestSource:
    def test_start(self) -> None:
        """A text begins at line 1, column 1."""
        assert str(Source("g.yaml", "a: 1").start) == "g.yaml:1:1"


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
