"""Values in a folder: nothing is lost, and what is damaged says so."""

import contextlib
import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from toys import Pair, toy_registry

from graphface import (
    Evaluator,
    Graph,
    GraphfaceWarning,
    MemoryTier,
    RunFailed,
    UnwritableFile,
    UsageError,
    load,
    node,
)
from graphface.report.dump import Dump, value_path
from graphface.values.value_file import read_value

INNER = """\
graphface: 1
inputs: {grid: Grid}
nodes: {pair: {use: toy.pair, in: {grid: grid}}}
outputs: {low: pair.low}
"""
TEXT = """\
graphface: 1
inputs: {x: float}
nodes:
  grid: {use: toy.grid, with: {size: 6}}
  inner: {use: inner.yaml, in: {grid: grid}}
  mean: {use: toy.mean, in: {grid: inner.low}}
  sum: {use: toy.add, in: {a: mean, b: x}}
  bad: {use: toy.fail, in: {a: sum}}
"""


@pytest.fixture
def graph(tmp_path_factory: pytest.TempPathFactory) -> Graph:
    folder = tmp_path_factory.mktemp("graphs")
    (folder / "inner.yaml").write_text(INNER)
    (folder / "outer.yaml").write_text(TEXT)
    return load(folder / "outer.yaml", registry=toy_registry())


def dumped(graph: Graph, folder: Path, outputs: list[str], evaluator: Evaluator | None = None) -> None:
    """What a run leaves in a folder, failed or not."""
    evaluator = evaluator or Evaluator()
    dump = Dump(folder, evaluator)
    dump.check()
    with contextlib.suppress(RunFailed):
        evaluator.run(graph.request({"x": 1.0}, outputs), [dump])
    dump.write()


def files_in(folder: Path) -> set[str]:
    return {path.relative_to(folder).as_posix() for path in folder.rglob("*") if path.is_file()}


class TestDump:
    def test_folder(self, graph: Graph, tmp_path: Path) -> None:
        """A picture and the data of every value, nested graphs as folders, and run.json."""
        dumped(graph, tmp_path / "d", ["sum"])
        names = {"x", "grid", "inner/pair", "mean", "sum"}
        assert files_in(tmp_path / "d") == {f"{n}{s}" for n in names for s in (".npz", ".png")} | {"run.json"}
        pair = read_value(value_path(tmp_path / "d", "inner/pair"), Pair)
        np.testing.assert_array_equal(pair.high, np.full((6, 6), 2.0))
        told = json.loads((tmp_path / "d/run.json").read_text(encoding="utf-8"))
        assert {node["name"] for node in told["nodes"]} == names

    def test_failed_run(self, graph: Graph, tmp_path: Path) -> None:
        """What was computed before a failure is there."""
        dumped(graph, tmp_path / "d", ["bad"])
        assert "sum.npz" in files_in(tmp_path / "d")
        assert "bad.npz" not in files_in(tmp_path / "d")

    def test_memoized(self, graph: Graph, tmp_path: Path) -> None:
        """Values that are looked up are written, those above them too."""
        evaluator = Evaluator(memory=MemoryTier())
        dumped(graph, tmp_path / "one", ["mean"], evaluator)
        dumped(graph, tmp_path / "two", ["mean"], evaluator)
        assert files_in(tmp_path / "one") == files_in(tmp_path / "two")

    def test_again(self, graph: Graph, tmp_path: Path) -> None:
        """A second dump into the folder leaves nothing of the first."""
        dumped(graph, tmp_path, ["sum"])
        dumped(graph, tmp_path, ["grid"])
        assert files_in(tmp_path) == {"grid.npz", "grid.png", "run.json"}

    def test_foreign_folder(self, graph: Graph, tmp_path: Path) -> None:
        """A folder with other files is left alone."""
        (tmp_path / "mine.txt").write_text("mine")
        with pytest.raises(UsageError, match="no --dump wrote"):
            dumped(graph, tmp_path, ["sum"])
        assert files_in(tmp_path) == {"mine.txt"}

    def test_cannot_be_stored(self, tmp_path: Path) -> None:
        """A value of no kind that can be stored has its picture, and a warning; the others are written."""
        registry = toy_registry()

        @node("odd.make")
        def make() -> Any:
            return {"file": open}

        registry.add(make)
        graph, evaluator = load("graphface: 1\nnodes: {odd: {use: odd.make}}\n", registry=registry), Evaluator()
        dump = Dump(tmp_path / "d", evaluator)
        dump.check()
        with pytest.warns(GraphfaceWarning, match="odd has its picture only"):
            evaluator.run(graph.request({}, ["odd"]), [dump])
        dump.write()
        assert files_in(tmp_path / "d") == {"odd.png", "run.json"}

    def test_disk_is_full(self, graph: Graph, tmp_path: Path) -> None:
        """A value that cannot be written ends the command with an error that names the file, not the run."""
        evaluator = Evaluator()
        dump = Dump(tmp_path / "d", evaluator)
        dump.check()
        (tmp_path / "d/inner").write_text("a file where a folder has to be")
        result = evaluator.run(graph.request({"x": 1.0}, ["sum"]), [dump])
        assert result["sum"] == 2
        with pytest.raises(UnwritableFile, match="inner"):
            dump.write()
