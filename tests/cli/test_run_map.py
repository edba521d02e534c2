"""`--map`: a graph for every file of a folder."""

from collections.abc import Callable
from pathlib import Path

import pytest

from graphface import Evaluator, Graph, MemoryTier, Registry, load
from graphface.cli.run_map import run_map
from graphface.errors import UsageError
from graphface.evaluate.mapping import MapFailed
from graphface.record import Record

TEXT = """graphface: 1
name: mapped
inputs: {g: Path}
nodes: {a: {use: toy.grid}}
outputs: {y: a}
"""


@pytest.fixture
def graph(registry: Registry) -> Graph:
    return load(TEXT, registry=registry)


@pytest.fixture
def mapped(graph: Graph, tmp_path: Path) -> Callable[[str], list[Record]]:
    """Runs the graph for the two files of a folder."""
    folder = tmp_path / "in"
    folder.mkdir()
    for name in ("one.txt", "two.txt"):
        (folder / name).write_text(name)

    def run(output: str) -> list[Record]:
        records: list[Record] = []
        evaluator = Evaluator(memory=MemoryTier())
        run_map(graph, [str(tmp_path / output)], {}, [f"g={folder}"], evaluator, records)
        return records

    return run


class TestMapped:
    def test_each(self, mapped: Callable[[str], list[Record]], tmp_path: Path) -> None:
        """Every file has its result; what they share is computed once."""
        records = mapped("{g}.npy")
        assert sorted(path.name for path in tmp_path.glob("*.npy")) == ["one.npy", "two.npy"]
        assert [record.state for record in records if record.name == "a"] == ["ran", "memory"]

    def test_one_file_twice(self, mapped: Callable[[str], list[Record]], tmp_path: Path) -> None:
        """Two results of one name are refused before anything runs."""
        with pytest.raises(UsageError, match=r"would be written for .*one.txt and for .*two.txt"):
            mapped("same.npy")
        assert not (tmp_path / "same.npy").exists()

    def test_two_outputs_of_one_name(self, graph: Graph, tmp_path: Path) -> None:
        """Also where it is two outputs of the same run."""
        (tmp_path / "one.txt").write_text("")
        with pytest.raises(UsageError, match="would be written to this one file"):
            run_map(graph, ["y={g}.npy", "a={g}.npy"], {}, [f"g={tmp_path}"], Evaluator(), [])

    def test_some_fail(self, registry: Registry, tmp_path: Path) -> None:
        """Where some fail, the error says so at the end."""
        failing = "b: {use: toy.number}, a: {use: toy.fail, in: {a: b}}"
        graph = load(TEXT.replace("a: {use: toy.grid}", failing), registry=registry)
        (tmp_path / "a.txt").write_text("")
        with pytest.raises(MapFailed):
            run_map(graph, [str(tmp_path / "{g}.npz")], {}, [f"g={tmp_path}"], Evaluator(), [])
