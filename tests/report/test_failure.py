"""What `--save-failure` keeps: the first node that fails, whole or not at all."""

import json
import zipfile
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from graphface import Evaluator, Graph, Registry, RunFailed, UnwritableFile, load, node
from graphface.report.failure import MANIFEST, FirstFailure, write_failure

TEXT = """graphface: 1
name: failing
inputs: {x: {type: float, default: 1}}
nodes:
  g: {use: toy.grid, with: {size: 3}}
  nan: {use: toy.poison, in: {grid: g}, with: {row: 2}}
  bad: {use: toy.fail, in: {a: x}}
  bad2: {use: toy.fail, in: {a: x}, with: {message: other}}
  rule: {use: toy.broken_rule, in: {a: x, extra: x}}
  fine: {use: toy.mean, in: {grid: g}}
"""


@pytest.fixture
def graph(registry: Registry) -> Graph:
    return load(TEXT, registry=registry)


def followed(graph: Graph, *outputs: str, threads: int = 1) -> FirstFailure:
    first = FirstFailure()
    with pytest.raises(RunFailed):
        Evaluator(threads=threads).run(graph.request({}, outputs), [first])
    return first


class TestFirstFailure:
    @pytest.mark.parametrize("threads", [1, 3])
    def test_arguments(self, graph: Graph, threads: int) -> None:
        """A node that fails is kept with what it was given, also where only its output was wrong."""
        failed = followed(graph, "nan", threads=threads).failed
        assert failed is not None
        assert failed.step.name == "nan"
        assert failed.arguments is not None
        assert failed.arguments["grid"].shape == (3, 3)

    def test_others(self, graph: Graph) -> None:
        """Of several the first is kept, the others by name."""
        failed = followed(graph, "bad", "bad2").failed
        assert failed is not None
        assert {failed.step.name, *failed.others} == {"bad", "bad2"}

    def test_next_run(self, graph: Graph) -> None:
        """A run that does not fail leaves nothing of the one before."""
        first = followed(graph, "bad")
        Evaluator().run(graph.request({}, ["fine"]), [first])
        assert first.failed is None


class TestWritten:
    def test_members(self, graph: Graph, tmp_path: Path) -> None:
        """Arrays are members of their own, all else is JSON."""
        failed = followed(graph, "nan").failed
        assert failed is not None
        write_failure(failed, tmp_path / "f.zip")
        with zipfile.ZipFile(tmp_path / "f.zip") as archive:
            assert sorted(archive.namelist()) == [MANIFEST, "inputs/0.npy"]
            about = json.loads(archive.read(MANIFEST))
            with archive.open("inputs/0.npy") as member:
                np.testing.assert_array_equal(np.load(member), np.ones((3, 3)))  # type: ignore[arg-type]
        assert (about["node"], about["operator"], about["graph"]) == ("nan", "toy.poison", "failing")
        assert about["place"].startswith("<text>:6:")
        assert "non-finite" in about["error"]
        assert [p.name for p in tmp_path.iterdir()] == ["f.zip"]

    def test_rule(self, graph: Graph, tmp_path: Path) -> None:
        """A node whose rule failed was given nothing, which is told."""
        failed = followed(graph, "rule").failed
        assert failed is not None
        with pytest.raises(UnwritableFile, match="needs rule"):
            write_failure(failed, tmp_path / "f.zip")
        assert list(tmp_path.iterdir()) == []

    def test_unstorable(self, registry: Registry, tmp_path: Path) -> None:
        """A value that cannot be stored is told by its port, and no file is left."""

        @node("odd.give")
        def give() -> object:
            return open  # a function is no value that can be stored

        @node("odd.take")
        def take(thing: Any) -> float:
            raise ValueError

        registry.add(give)
        registry.add(take)
        graph = load(
            "graphface: 1\nnodes:\n  a: {use: odd.give}\n  b: {use: odd.take, in: {thing: a}}\n", registry=registry
        )
        failed = followed(graph, "b").failed
        assert failed is not None
        with pytest.raises(UnwritableFile, match="thing"):
            write_failure(failed, tmp_path / "f.zip")
        assert list(tmp_path.iterdir()) == []
