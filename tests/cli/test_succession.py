"""Values go from one process to the next through a folder that does not stay."""

import os
from pathlib import Path

import numpy as np
import pytest

from graphface import Evaluator, MemoryTier, Registry, load
from graphface.cli.succession import Succession
from graphface.report.history import History, Remember

TEXT = (
    "graphface: 1\nname: handed\nnodes:\n  g: {use: toy.grid}\n  s: {use: toy.scale, in: {grid: g}}\noutputs: {s: s}\n"
)


class Replaced(Exception):
    """What stands here for becoming another process."""


@pytest.fixture(autouse=True)
def no_exec(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    def exec_(*_: object) -> None:
        raise Replaced

    monkeypatch.setattr(os, "execv", exec_)
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path))
    monkeypatch.delenv("GRAPHFACE_WATCH", raising=False)


def evaluator() -> Evaluator:
    return Evaluator(memory=MemoryTier())


def test_handed_over(registry: Registry, ran: list[str], tmp_path: Path) -> None:
    """The next process has values, history and files; the folder is gone as soon as it runs."""
    graph, first, history = load(TEXT, registry=registry), evaluator(), History()
    request = graph.request()
    first.run(request, [Remember(history, None)])
    with pytest.raises(Replaced):
        Succession(first).hand_over(request, history, [tmp_path / "code.py"])
    ran.clear()
    second, learned = evaluator(), History()
    succession = Succession(second)
    assert succession.files == {tmp_path / "code.py"}
    result = second.run(graph.request(), [succession.heir(learned)])
    np.testing.assert_array_equal(result["s"], np.full((4, 4), 2.0))
    assert ran == []
    assert set(learned.last("handed")) == {"g", "s"}
    assert list(tmp_path.glob("graphface-watch-*")) == []
    assert "GRAPHFACE_WATCH" not in os.environ


def test_handed_on(registry: Registry, ran: list[str], tmp_path: Path) -> None:
    """A process that never came to run hands on what it was given."""
    graph, first, history = load(TEXT, registry=registry), evaluator(), History()
    first.run(graph.request(), [Remember(history, None)])
    with pytest.raises(Replaced):
        Succession(first).hand_over(graph.request(), history, [])
    with pytest.raises(Replaced):
        Succession(evaluator()).hand_over(None, History(), [])
    ran.clear()
    third = evaluator()
    third.run(graph.request(), [Succession(third).heir(History())])
    assert ran == []


def test_nothing_left(tmp_path: Path) -> None:
    """Without a folder, or with one that is gone, it begins anew."""
    os.environ["GRAPHFACE_WATCH"] = str(tmp_path / "gone")
    succession = Succession(evaluator())
    assert succession.files == set()
    succession.end()
