"""A run against known-good values in a folder."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from graphface import Evaluator, MemoryTier, UnreadableFile
from graphface.facade import Graph
from graphface.report.difference.golden import GoldenComparison
from graphface.report.difference.side import Side
from graphface.report.difference.tolerance import Tolerance
from graphface.report.trace import Trace
from graphface.values.value_file import write_value

Made = Callable[..., Graph]


def dumped(graph: Graph, folder: Path, **inputs: Any) -> Path:
    """A folder as `run --dump` writes it."""
    trace, evaluator = Trace(), Evaluator(memory=MemoryTier())
    asked = graph.request(inputs)
    evaluator.run(asked, [trace])
    side = Side(asked, evaluator, trace.records)
    for name in side.needed:
        path = folder / f"{name}.npz"
        path.parent.mkdir(parents=True, exist_ok=True)
        write_value(side.value(name), path)
    trace.write_to(folder / "run.json")
    return folder


def against(graph: Graph, folder: Path, **inputs: Any) -> GoldenComparison:
    return GoldenComparison(graph.request(inputs), folder, Evaluator(memory=MemoryTier()))


class TestGolden:
    def test_round_trip(self, graph: Made, tmp_path: Path) -> None:
        """What was dumped is what it is."""
        found = against(graph(), dumped(graph(), tmp_path)).differences(Tolerance())
        assert not found
        assert (found.compared, list(found.below)) == (5, [])

    def test_first_that_goes_wrong(self, graph: Made, tmp_path: Path) -> None:
        """The node that was changed, with its parameter then and now; those below say no more than that they differ."""
        found = against(graph(set={"s.by": 4}), dumped(graph(), tmp_path)).differences()
        assert [node.name for node in found] == ["s", "t", "m", "n"]
        assert [str(reason) for reason in found.first.reasons] == ["parameter by changed from 3.0 to 4.0"]

    def test_another_operator_of_equal_values(self, graph: Made, tmp_path: Path) -> None:
        """Only values count."""
        text = "graphface: 1\nnodes: {g: {use: toy.%s}, m: {use: toy.mean, in: {grid: g}}}\noutputs: {y: m}\n"
        assert not against(graph(text % "fine"), dumped(graph(text % "grid"), tmp_path)).differences()

    def test_default_tolerance(self, graph: Made, tmp_path: Path) -> None:
        """A change that another processor could make is none, a hundred times that is one."""
        folder = dumped(graph(), tmp_path)
        slight = against(graph(set={"s.by": 3 * (1 + 1e-6)}), folder).differences()
        assert (len(slight), [node.name for node in slight.below]) == (0, ["s", "t", "m", "n"])
        assert len(against(graph(set={"s.by": 3 * (1 + 1e-4)}), folder).differences()) == 4

    def test_nodes_of_one_side(self, graph: Made, tmp_path: Path) -> None:
        """A node without a known-good value is named, and a value without its node."""
        folder = dumped(graph(), tmp_path)
        (folder / "t.npz").rename(folder / "gone.npz")
        run = json.loads((folder / "run.json").read_text())
        run["nodes"] = [node for node in run["nodes"] if node["name"] != "t"]
        (folder / "run.json").write_text(json.dumps(run))
        found = against(graph(), folder).differences()
        assert {node.name: node.kind for node in found} == {"gone": "only there", "t": "only here"}

    def test_value_that_could_not_be_stored(self, graph: Made, tmp_path: Path) -> None:
        """It is said to be not compared, and is no difference."""
        folder = dumped(graph(), tmp_path)
        (folder / "t.npz").unlink()
        found = against(graph(), folder).differences()
        assert (len(found), [name for name, _ in found.not_compared]) == (0, ["t"])

    def test_damaged_value(self, graph: Made, tmp_path: Path) -> None:
        """A file that is no value is a difference with the reason, not a crash."""
        folder = dumped(graph(), tmp_path)
        (folder / "t.npz").write_bytes(b"PK\x03\x04")
        found = against(graph(), folder).differences()
        assert [(node.name, node.kind) for node in found] == [("t", "only here")]
        assert "no known-good value" in found.nodes[0].words

    def test_failure(self, graph: Made, tmp_path: Path) -> None:
        """A node that fails now is the first that goes wrong."""
        text = "graphface: 1\nnodes: {a: {use: toy.number}, f: {use: toy.%s, in: {a: a}}}\noutputs: {y: f}\n"
        found = against(graph(text % "fail"), dumped(graph(text % "add"), tmp_path)).differences()
        assert [(node.name, node.words) for node in found] == [("f", "now: ValueError: it broke")]

    def test_equal_nodes(self, graph: Made, tmp_path: Path) -> None:
        """Of two equal nodes a run evaluates one: the other needs no value of its own."""
        nodes = "{a: {use: toy.grid}, b: {use: toy.grid}, m: {use: toy.mean, in: {grid: a}}}"
        text = f"graphface: 1\nnodes: {nodes}\noutputs: {{y: m, z: b}}\n"
        folder = dumped(graph(text), tmp_path)
        (folder / "b.npz").unlink()
        run = json.loads((folder / "run.json").read_text())
        run["nodes"] = [node for node in run["nodes"] if node["name"] != "b"]
        (folder / "run.json").write_text(json.dumps(run))
        assert not against(graph(text), folder).differences()

    def test_no_such_folder(self, graph: Made, tmp_path: Path) -> None:
        """Says that there is no run in it."""
        with pytest.raises(UnreadableFile, match=r"run\.json"):
            against(graph(), tmp_path)

    def test_nan(self, graph: Made, tmp_path: Path) -> None:
        """NaN where there was a number is beyond every tolerance."""
        folder = dumped(graph(), tmp_path)
        spoilt = np.full((8, 8), 3.0)
        spoilt[2, 3] = np.nan
        write_value(spoilt, folder / "s.npz")
        found = against(graph(), folder).differences(Tolerance(absolute=1e9))
        assert [(node.name, node.parts[0].position) for node in found] == [("s", (2, 3))]
