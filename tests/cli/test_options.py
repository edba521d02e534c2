"""Options that commands share: inputs, choices, the cache."""

import os
from pathlib import Path

import pytest

from graphface import UsageError
from graphface.cli.options import load_graph, open_cache, open_evaluator, read_inputs


class TestReadInputs:
    def test_pairs(self) -> None:
        """A value may hold further equals signs."""
        assert read_inputs(["x=1", "path=a=b.jpg"]) == {"x": "1", "path": "a=b.jpg"}

    @pytest.mark.parametrize("text", ["x", "=1", "x=", ""])
    def test_no_pair(self, text: str) -> None:
        """What is no pair is refused, with the form that is expected."""
        with pytest.raises(UsageError, match="NAME=VALUE"):
            read_inputs([text])

    def test_twice(self) -> None:
        """An input is given once; many files go through `--map`."""
        with pytest.raises(UsageError, match="--map x="):
            read_inputs(["x=1", "x=2"])


class TestOpenCache:
    def test_none(self) -> None:
        """No folder, no cache."""
        assert open_cache(None, []) is None

    def test_size(self, tmp_path: Path) -> None:
        """What the folder may hold is a size."""
        assert open_cache(tmp_path / "c", [], "5MB").stats().budget_bytes == 5_000_000
        with pytest.raises(UsageError):
            open_cache(tmp_path / "c", [], "much")


def test_load_graph(graph: Path, plugin: list[str]) -> None:
    """Every choice of the command line reaches the graph."""
    loaded = load_graph(str(graph), ["s.by=9"], ["s=toy.scale"], [], ["draft"], [Path(plugin[1])])
    assert loaded.run(["s"])["s"].tolist() == [[9.0, 9.0], [9.0, 9.0]]


class TestEvaluator:
    def test_flags(self) -> None:
        """Threads, guard and the memory tier are as the flags say; 0 threads are one per core."""
        evaluator = open_evaluator([], None, None, "1M", threads=3, guard="warn")
        assert (evaluator.threads, evaluator.guard, evaluator.disk) == (3, "warn", None)
        assert evaluator.memory is not None
        assert evaluator.memory.budget == 1_000_000
        assert open_evaluator([], None, None, None, keeps=False).memory is None
        assert open_evaluator([], None, None, None).threads == (os.cpu_count() or 1)

    def test_refused(self) -> None:
        """Another guard is refused, with those that there are."""
        with pytest.raises(UsageError, match="expected off, warn or error"):
            open_evaluator([], None, None, None, guard="loud")
