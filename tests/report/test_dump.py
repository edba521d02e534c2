"""Values in a folder: nothing is lost, and what is damaged says so."""

import contextlib
import json
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from toys import Grid, Pair, toy_registry

from graphface import (
    Evaluator,
    Graph,
    GraphfaceWarning,
    MemoryTier,
    RunFailed,
    UnreadableFile,
    UnwritableFile,
    UsageError,
    load,
    node,
)
from graphface.report.dump import Dump, read_value, value_path, write_value
from graphface.values.codec import encode


class TestValues:
    @pytest.mark.parametrize(
        ("value", "annotation"),
        [
            (1.5, float),
            ("text", str),
            (None, Pair | None),
            (np.array([[np.nan, -np.inf], [0.1, 1e-40]]), Grid),
            (Pair(np.arange(6.0).reshape(2, 3)), Pair),
            ([np.zeros((0, 3), np.float32), np.ones(2, np.int64)], list[Any]),
        ],
    )
    def test_comes_back(self, tmp_path: Path, value: Any, annotation: Any) -> None:
        """Arrays bit by bit, with NaN, dtype and shape; records as their class."""
        write_value(value, tmp_path / "v.npz")
        back = read_value(tmp_path / "v.npz", annotation)
        assert type(back) is type(value)
        held, found = encode(value), encode(back)
        assert held[1] == found[1]
        assert [array.tobytes() for array in held[0].values()] == [array.tobytes() for array in found[0].values()]

    def test_numpy_reads_it(self, tmp_path: Path) -> None:
        """NumPy alone opens the file: arrays by number, and the structure as a text."""
        write_value(Pair(np.ones((2, 3))), tmp_path / "v.npz")
        with np.load(tmp_path / "v.npz", allow_pickle=False) as held:
            assert sorted(held.files) == ["0", "structure"]
            assert held["0"].shape == (2, 3)

    def test_unknown_type(self, tmp_path: Path) -> None:
        """What cannot be stored is refused, and no file is left."""

        class Opaque:
            pass

        with pytest.raises(UnwritableFile, match="Opaque"):
            write_value(Opaque(), tmp_path / "v.npz")
        assert not list(tmp_path.iterdir())

    def test_other_type(self, tmp_path: Path) -> None:
        """A value is read as the type that is asked for, or not at all."""

        @dataclass(frozen=True)
        class Other:
            low: int

        write_value(Pair(np.ones((2, 3))), tmp_path / "v.npz")
        with pytest.raises(UnreadableFile, match="not a"):
            read_value(tmp_path / "v.npz", Other)

    def test_no_value(self, tmp_path: Path) -> None:
        """A file that is not there, is damaged, or is another .npz is named with the reason."""
        np.savez(tmp_path / "other.npz", a=np.ones(2))
        (tmp_path / "damaged.npz").write_bytes(b"PK\x03\x04 and nothing more")
        for name in ("missing", "damaged", "other"):
            with pytest.raises(UnreadableFile, match=name):
                read_value(tmp_path / f"{name}.npz", float)


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
