"""One run: outputs written when all are there; without `-o` only where somebody looks into the run."""

from pathlib import Path

import pytest

from graphface import Evaluator, Registry, load
from graphface.cli.following import Follower, TraceFile
from graphface.cli.run_once import run_once
from graphface.errors import UsageError

TEXT = "graphface: 1\nname: one\ninputs: {x: {type: float, default: 1}}\nnodes: {a: {use: toy.grid}}\n"


class TestWithoutOutput:
    def test_followed(self, registry: Registry) -> None:
        """A run that is followed computes all declared outputs, and writes none of them."""
        graph = load(TEXT + "outputs: {y: a}\n", registry=registry)
        records = run_once(graph, [], {}, Evaluator(), [Follower()], history=None)
        assert [record.name for record in records] == ["a"]

    @pytest.mark.parametrize(("outputs", "followers"), [("{y: a}", []), ("{}", [Follower()])])
    def test_refused(self, registry: Registry, outputs: str, followers: list[Follower]) -> None:
        """Where nobody looks, or the graph declares no output, an output has to be named."""
        graph = load(f"{TEXT}outputs: {outputs}\n", registry=registry)
        with pytest.raises(UsageError, match="no output asked for"):
            run_once(graph, [], {}, Evaluator(), followers, history=None)


class TestFiles:
    def test_one_file_for_two(self, registry: Registry, tmp_path: Path) -> None:
        """Two outputs of one name are refused before anything runs, and so is what is written beside them."""
        graph = load(f"{TEXT}outputs: {{y: a}}\n", registry=registry)
        trace = TraceFile(tmp_path / "a.npy", peaks=False)
        for output, followers in ((["y=a.npy", "a=./a.npy"], []), ([f"y={tmp_path / 'a.npy'}"], [trace])):
            with pytest.raises(UsageError, match="would be written to this one file"):
                run_once(graph, output, {}, Evaluator(), followers, history=None)


def test_written(registry: Registry, tmp_path: Path) -> None:
    """What is named is written, and the run told."""
    graph = load(TEXT, registry=registry)
    records = run_once(graph, [f"a={tmp_path / 'a.npy'}"], {}, Evaluator(), [], history=None)
    assert (tmp_path / "a.npy").is_file()
    assert [record.state for record in records] == ["ran"]
