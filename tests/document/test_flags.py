"""`--set` and `--replace`: texts of the command line as settings with a place."""

import pytest

from graphface.document.flags import flag_overlays, read_flag
from graphface.document.overlays import Rank
from graphface.errors import DocumentError, Problem


class TestReadFlag:
    @pytest.mark.parametrize(
        ("text", "expected"),
        [
            ("a.b=1", ("a.b", 1)),
            ("a/b.c=1e0", ("a/b.c", 1.0)),
            ("a.b=on", ("a.b", "on")),
            ("a.b=", ("a.b", None)),
            ("a.b=x=y", ("a.b", "x=y")),
            ("a.b='1'", ("a.b", "1")),
            ("a.b=[1, x]", ("a.b", [1, "x"])),
            ("a.b={k: 1}", ("a.b", {"k": 1})),
        ],
    )
    def test_value(self, text: str, expected: tuple[str, object]) -> None:
        """The value of a flag is read as YAML would."""
        assert read_flag(text, "--set") == expected

    @pytest.mark.parametrize(
        "text", ["a.b", "=1", "a b=1", "a..b=1", "a.b=[1", "a.b={k: 1, k: 2}", "a.b=[1]\nx: 2: 3", "a.b='x"]
    )
    def test_refused(self, text: str) -> None:
        """A flag that is not name=value is refused with the flag as its place."""
        with pytest.raises(DocumentError) as caught:
            read_flag(text, "--set")
        place = caught.value.problems[0].place
        assert place is not None
        assert place.source.name == "--set"
        assert place.excerpt.splitlines()[0].strip() == text.splitlines()[0]


class TestFlagOverlays:
    def test_addressed_by_path(self) -> None:
        """A flag reaches its node by path; replacing ranks below setting."""
        problems: list[Problem] = []
        one, other = flag_overlays({"face/light": "sh.fit"}, {"face/light.order": 2}, problems)
        assert problems == []
        assert (one.rank, other.rank) == (Rank.REPLACE, Rank.SET)
        assert one.path == other.path == ("face", "light")
        assert one.entry.use is not None
        assert one.entry.use.value == "sh.fit"
        assert other.entry.settings["order"].value == 2

    def test_place_is_the_flag(self) -> None:
        """What is wrong with a setting is shown in the flag that says it, and the others still count."""
        problems: list[Problem] = []
        (kept,) = flag_overlays({}, {"order": 2, "light.order": 3}, problems)
        assert kept.path == ("light",)
        (problem,) = problems
        assert "node.parameter" in problem.message
        assert problem.place is not None
        assert (problem.place.source.name, problem.place.source.text) == ("--set", "order=2")
