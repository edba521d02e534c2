"""A trace says what happened at every node, and is written whatever happened."""

import contextlib
import json
import tracemalloc
from pathlib import Path
from typing import Any

import pytest
from toys import toy_registry

from graphface import Evaluator, MemoryTier, Registry, RunFailed, UnwritableFile, load
from graphface.cli import main
from graphface.report.trace import Trace

TEXT = """\
graphface: 1
name: traced
inputs: {x: float}
nodes:
  a: {use: toy.add, in: {a: x}, with: {plus: 2}}
  warned: {use: toy.fall_back, in: {a: a}}
  grid: {use: toy.grid, with: {size: 256}}
  twice: {use: toy.scale, in: {grid: grid}}
  bad: {use: toy.fail, in: {a: warned}}
  below: {use: toy.add, in: {a: bad}}
  gate: {use: toy.gate, in: {a: a, extra: warned}, with: {open: false}}
"""


def traced(outputs: list[str], trace: Trace, evaluator: Evaluator | None = None, **options: Any) -> dict[str, Any]:
    """What a trace says after a run of TEXT with x = 1, failed or not."""
    graph = load(TEXT, registry=toy_registry())
    evaluator = evaluator or Evaluator(memory=MemoryTier(), **options)
    evaluator.observers = (trace,)
    with contextlib.suppress(RunFailed):
        evaluator.run(graph.request({"x": 1.0}, outputs))
    return trace.as_json()


def nodes_of(said: dict[str, Any]) -> dict[str, dict[str, Any]]:
    return {entry["name"]: entry for entry in said["nodes"]}


class TestContents:
    def test_run(self) -> None:
        """Versions, the graph and its effective document, and the inputs with their digests."""
        said = traced(["a"], Trace())
        assert {"python", "graphface", "numpy"} <= said["versions"].keys()
        assert said["graph"] == "traced"
        assert load(said["document"], registry=toy_registry()).name == "traced"
        assert said["inputs"].keys() == {"x"}
        assert len(said["inputs"]["x"]["digest"]) == 32

    def test_node(self) -> None:
        """Key, state, times, bytes, thread, parameters, value and warnings of a node."""
        entry = nodes_of(traced(["grid"], Trace()))["grid"]
        assert (entry["operator"], entry["state"], entry["bytes"]) == ("toy.grid", "ran", 256 * 256 * 8)
        assert len(entry["key"]) == 32
        assert min(entry["wall_ms"], entry["cpu_ms"]) >= 0
        assert entry["thread"] == "MainThread"
        assert entry["parameters"] == {"size": 256, "fill": 1.0, "label": "grid"}
        assert entry["value"] == "float64[256, 256] 1..1"

    def test_warnings(self) -> None:
        """What a node fell back on is in its entry and in no other."""
        found = nodes_of(traced(["warned"], Trace()))
        assert {name: entry["warnings"] for name, entry in found.items() if entry["warnings"]} == {
            "warned": ["3.0 was too much"]
        }

    def test_threads(self) -> None:
        """With several threads, a node's thread is the worker that ran it."""
        assert nodes_of(traced(["a"], Trace(), threads=2))["a"]["thread"].startswith("graphface")

    def test_memoized(self) -> None:
        """A memoized node has its state and value, and no thread."""
        evaluator = Evaluator(memory=MemoryTier())
        traced(["grid"], Trace(), evaluator)
        entry = nodes_of(traced(["grid"], Trace(), evaluator))["grid"]
        assert (entry["state"], entry["thread"], entry["value"]) == ("memory", None, "float64[256, 256] 1..1")

    def test_failed(self) -> None:
        """A failure has its reason, what it blocks is there too, and both have no value."""
        found = nodes_of(traced(["below"], Trace()))
        assert (found["bad"]["state"], found["bad"]["reason"]) == ("failed", "ValueError: it broke")
        assert found["below"]["state"] == "blocked"
        assert (found["bad"]["value"], found["below"]["value"]) == (None, None)
        assert found["warned"]["state"] == "ran"

    def test_declined(self) -> None:
        """A declined port has the reason."""
        assert nodes_of(traced(["gate"], Trace()))["gate.extra"]["reason"] == "the gate is shut"

    def test_used_again(self) -> None:
        """A trace that sees a second run tells of that run alone."""
        trace = Trace()
        traced(["grid"], trace)
        assert nodes_of(traced(["a"], trace)).keys() == {"x", "a"}

    def test_odd_parameters(self, registry: Registry) -> None:
        """Parameters that JSON does not know are shown all the same, and the text is strict JSON."""
        trace = Trace()
        odd = {"n.anything": {1: Path("a")}, "n.items": [float("inf")]}
        graph = load("graphface: 1\nnodes: {n: {use: toy.options}}\n", registry=registry, set=odd)
        Evaluator().run(graph.request({}, ["n"]), [trace])
        said = json.dumps(trace.as_json(), allow_nan=False)
        assert json.loads(said)["nodes"][0]["parameters"] == {
            "table": None,
            "items": ["inf"],
            "anything": {"1": repr(Path("a"))},
        }


class TestPeaks:
    def test_array(self) -> None:
        """A node's peak is at least what it returns: here half a MiB of float64, made and scaled."""
        found = nodes_of(traced(["twice"], Trace(peaks=True)))
        for name in ("grid", "twice"):
            assert 256 * 256 * 8 <= found[name]["peak_bytes"] < 3 * 256 * 256 * 8

    def test_not_asked(self) -> None:
        """Without `peaks` nothing is measured and nothing is slowed down."""
        assert nodes_of(traced(["grid"], Trace()))["grid"]["peak_bytes"] is None
        assert not tracemalloc.is_tracing()

    def test_failed(self) -> None:
        """A failed node's peak is a size too, and tracing stops after the run."""
        found = nodes_of(traced(["below"], Trace(peaks=True)))
        assert found["bad"]["peak_bytes"] >= 0
        assert found["below"]["peak_bytes"] is None
        assert not tracemalloc.is_tracing()

    def test_somebody_else_traces(self) -> None:
        """Tracing that was on before the run stays on."""
        tracemalloc.start()
        try:
            traced(["grid"], Trace(peaks=True))
            assert tracemalloc.is_tracing()
        finally:
            tracemalloc.stop()


class TestFile:
    def test_written(self, tmp_path: Path, registry: Registry) -> None:
        """`write` leaves the same as JSON."""
        graph = load(TEXT, registry=registry)
        trace = Trace()
        Evaluator().run(graph.request({"x": 1.0}, ["a"]), [trace])
        trace.write_to(tmp_path / "run.json")
        assert json.loads((tmp_path / "run.json").read_text()) == trace.as_json()

    def test_no_folder(self, tmp_path: Path, registry: Registry) -> None:
        """Where it cannot be written, that is an error about the file."""
        (tmp_path / "file").touch()
        trace = Trace()
        Evaluator().run(load(TEXT, registry=registry).request({"x": 1.0}, ["a"]), [trace])
        with pytest.raises(UnwritableFile):
            trace.write_to(tmp_path / "file" / "run.json")


PLUGIN = """\
from graphface import node
import numpy as np

@node("mine.grid")
def grid(x: float) -> np.ndarray:
    return np.full((128, 128), x)

@node("mine.fail")
def fail(grid: np.ndarray) -> np.ndarray:
    raise ValueError("no")
"""

GRAPH = """\
graphface: 1
inputs: {x: float}
nodes:
  grid: {use: mine.grid, in: {x: x}}
  bad: {use: mine.fail, in: {grid: grid}}
outputs: {grid: grid, bad: bad}
"""


class TestCommand:
    def run(self, folder: Path, *flags: str) -> tuple[int, dict[str, Any]]:
        """`graphface run --trace`: the exit code and what was written."""
        (folder / "mine.py").write_text(PLUGIN)
        (folder / "graph.yaml").write_text(GRAPH)
        trace = folder / "run.json"
        with pytest.raises(SystemExit) as left:
            main(
                ["run", str(folder / "graph.yaml"), "--plugin", str(folder / "mine.py"), "--trace", str(trace), *flags]
            )
        return int(left.value.code or 0), json.loads(trace.read_text())

    def test_run(self, tmp_path: Path) -> None:
        """--trace writes run.json beside the results."""
        code, said = self.run(tmp_path, "-i", "x=1", "-o", f"grid={tmp_path}/grid.npy")
        assert code == 0
        assert [entry["state"] for entry in said["nodes"]] == ["ran", "ran"]

    def test_failure(self, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
        """A run that fails leaves its trace."""
        code, said = self.run(tmp_path, "-i", "x=1", "-o", f"bad={tmp_path}/bad.npy")
        assert code == 1
        assert nodes_of(said)["bad"]["state"] == "failed"

    def test_peaks(self, tmp_path: Path) -> None:
        """--peaks adds the peak of memory of every node."""
        _, said = self.run(tmp_path, "-i", "x=1", "--peaks", "-o", f"grid={tmp_path}/grid.npy")
        assert nodes_of(said)["grid"]["peak_bytes"] >= 128 * 128 * 8

    def test_peaks_without_trace(self, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
        """--peaks without a trace to stand in is a mistake."""
        (tmp_path / "graph.yaml").write_text("graphface: 1\nnodes: {}\n")
        with pytest.raises(SystemExit) as left:
            main(["run", str(tmp_path / "graph.yaml"), "--peaks", "-o", "x.npy"])
        assert left.value.code == 2
        assert "--trace" in capsys.readouterr().err
