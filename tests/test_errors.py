"""Errors carry their parts; the sentence is built from them."""

import pytest

from graphface import GraphfaceWarning, warn
from graphface.errors import (
    DocumentError,
    InputError,
    NodeError,
    Problem,
    RunFailed,
    UnknownOperator,
    did_you_mean,
    nearest_names,
)
from graphface.fallback import collector
from graphface.place import Place, Source

PLACE = Place(Source("g.yaml", "abc\nnodes: x\n"), 2, 8)


class TestNearestNames:
    @pytest.mark.parametrize(
        ("name", "known", "best"),
        [
            ("imge", ["image", "mask"], "image"),
            ("shade", ["render.shade", "render.spread"], "render.shade"),
            ("intrinsics.intensity", ["intrinsic.intensity", "sh.fit"], "intrinsic.intensity"),
        ],
    )
    def test_best_first(self, name: str, known: list[str], best: str) -> None:
        """The likeliest comes first; another prefix is near."""
        assert nearest_names(name, known)[0] == best

    def test_nothing_near(self) -> None:
        """Where nothing is near nothing is proposed."""
        assert nearest_names("zebra", ["image"]) == []
        assert did_you_mean([]) == ""

    def test_words(self) -> None:
        """The question reads like one."""
        assert did_you_mean(["a", "b"]) == "; did you mean 'a' or 'b'?"


class TestProblems:
    def test_with_place(self) -> None:
        """A problem shows place, message, proposal, line and caret."""
        text = str(Problem("no such thing", PLACE, ("y",)))
        assert text == "g.yaml:2:8: no such thing; did you mean 'y'?\n    nodes: x\n           ^"

    def test_without_place(self) -> None:
        """Without a place it is the sentence."""
        assert str(Problem("no such thing")) == "no such thing"

    def test_all(self) -> None:
        """A `DocumentError` holds and shows all of them."""
        error = DocumentError([Problem("one"), Problem("two")])
        assert len(error.problems) == 2
        assert str(error) == "one\ntwo"


class TestParts:
    def test_unknown_name(self) -> None:
        """An unknown name is a `LookupError` too, and prints as a sentence, not as a repr."""
        error = UnknownOperator("a.c", ["a.b", "x.y"])
        assert isinstance(error, LookupError)
        assert (error.name, error.nearest, error.known) == ("a.c", ["a.b"], ["a.b", "x.y"])
        assert str(error) == "unknown operator 'a.c'; did you mean 'a.b'?"

    def test_input(self) -> None:
        """An input's error has its name and reason."""
        error = InputError("x", "is red", ["y"])
        assert (error.name, error.reason, error.nearest) == ("x", "is red", ["y"])

    def test_node(self) -> None:
        """A node's failure shows place, names, reason and inputs."""
        text = str(NodeError("n", "a.b", PLACE, "it broke", {"p": "float32[2]"}))
        assert text == "g.yaml:2:8: node 'n' (a.b) failed: it broke\n    p: float32[2]"

    def test_run(self) -> None:
        """A failed run has its failures and what was finished."""
        failure = NodeError("n", "a.b", None, "it broke", {})
        error = RunFailed([failure], {"y": 1})
        assert (error.failures, error.finished) == ([failure], {"y": 1})


class TestWarn:
    def test_outside_a_run(self) -> None:
        """Outside a run a fallback is an ordinary Python warning, at the caller's line."""
        with pytest.warns(GraphfaceWarning, match="fell back") as caught:
            warn("fell back")
        assert caught[0].filename == __file__

    def test_collected(self) -> None:
        """Inside a run it is collected."""
        said: list[str] = []
        token = collector.set(said)
        warn("fell back")
        collector.reset(token)
        assert said == ["fell back"]
