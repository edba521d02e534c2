"""The prompt answers every command and every mistake in words, whether it is typed or read from a pipe."""

import io
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from PIL import Image

from graphface import Breakpoint, Evaluator, MemoryTier, Registry, RunFailed, StopRun, load
from graphface.debug.prompt import Prompt

TEXT = """graphface: 1
inputs: {x: {type: float, default: 1}}
nodes:
  a: {use: toy.add, in: {a: x}, with: {plus: 1}}
  g: {use: toy.grid}
  p: {use: toy.pair, in: {grid: g}, with: {both: true}}
  s: {use: toy.scale, in: {grid: p.low}}
  bad: {use: toy.fail, in: {a: a}}
outputs: {s: s, p: p}
"""
Ask = Callable[..., str]


@pytest.fixture
def ask(registry: Registry, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str], tmp_path: Path) -> Ask:
    """Runs the graph with a breakpoint and the commands typed in at it; tells what was printed."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(Prompt, "_introduced", False)

    def run(where: str | list[str], *commands: str, outputs: Any = ("s",), evaluator: Any = None) -> str:
        monkeypatch.setattr(sys, "stdin", io.StringIO("".join(f"{c}\n" for c in commands)))
        evaluator = evaluator or Evaluator(memory=MemoryTier())
        graph = load(TEXT, registry=registry)
        run.result = evaluator.run(graph.request({}, outputs), [Breakpoint(where)])  # type: ignore[attr-defined]
        out = capsys.readouterr().out
        assert "Traceback" not in out
        return out

    return run


class TestLooks:
    def test_headline(self, ask: Ask) -> None:
        """It begins with where the run stands; the hint is given once."""
        out = ask(["g", "p"], "c", "c")
        assert "before g (toy.grid), <text>:5:3\nhelp lists" in out
        assert out.count("help lists") == 1

    def test_inputs(self, ask: Ask) -> None:
        """Every port with where its value comes from, and the value in a line."""
        assert "grid <- p.low: float64[4, 4] 1..1" in ask("s", "inputs", "c")
        assert "it has none" in ask("g", "inputs", "c")

    def test_value(self, ask: Ask) -> None:
        """The parts of a record have lines of their own; before the node there is no value."""
        assert ".high float64[4, 4] 2..2" in ask("p:after", "value", "c")
        assert "--break p:after" in ask("p", "value", "c")

    def test_params(self, ask: Ask) -> None:
        """Parameters, those that the file sets with their place."""
        out = ask("p", "params", "c")
        assert "both" in out
        assert "<text>:6:" in out
        assert "'pair'" in out

    def test_where(self, ask: Ask) -> None:
        """The line of the file, what is plugged in and who uses it; `graph` is the same."""
        for command in ("where", "graph"):
            out = ask("p", command, "c", outputs=["s", "p"])
            assert "p: {use: toy.pair" in out
            assert all(wire in out for wire in ("grid <- g", "-> s.grid", "-> output p"))

    def test_failed(self, ask: Ask, capsys: pytest.CaptureFixture[str]) -> None:
        """After a failure the error stands in the headline, and the inputs are there."""
        with pytest.raises(RunFailed):
            ask("bad:after", "inputs", "value", "c", outputs=["bad"])
        out = capsys.readouterr().out
        assert "it failed: ValueError: it broke" in out
        assert "a <- a: 2.0" in out
        assert "error: it has no value" in out

    def test_memoized(self, ask: Ask) -> None:
        """A value that was memoized can be looked at, its inputs cannot."""
        evaluator = Evaluator(memory=MemoryTier())
        ask("a", outputs=["s"], evaluator=evaluator)
        assert "not at hand" in ask("s:after", "inputs", "pdb", "value", "c", evaluator=evaluator)

    def test_help(self, ask: Ask) -> None:
        """Every command has a line of help."""
        out = ask("s", "help", "help show", "h n", "help nothing", "c")
        for command in Prompt.get_names(Prompt):  # type: ignore[arg-type]
            if command.startswith("do_"):
                assert command[3:] in out
                assert getattr(Prompt, command).__doc__
        assert "no command 'nothing'" in out


class TestFiles:
    def test_show(self, ask: Ask, tmp_path: Path) -> None:
        """A value is drawn into the file named."""
        ask("s:after", "show grid a.png", "show value b.png", "c")
        assert Image.open(tmp_path / "a.png").size == Image.open(tmp_path / "b.png").size == (4, 4)

    def test_show_somewhere(self, ask: Ask) -> None:
        """Without a file the picture goes to a temporary one, whose name is told."""
        out = ask("s", "show grid", "c")
        path = next(line for line in out.splitlines() if "graphface-" in line).partition(": ")[0]
        assert Path(path).is_file()

    def test_save(self, ask: Ask, tmp_path: Path) -> None:
        """A value, or a field of one, is written as an output would be; all of it to .npz, which replace reads."""
        ask("p:after", "save value.high h.npy", "save value 'a b.npz'", "c")
        assert np.load(tmp_path / "h.npy").max() == 2
        assert "p is replaced by" in ask("p:after", "replace 'a b.npz'", "c")

    def test_replace(self, ask: Ask, tmp_path: Path) -> None:
        """This node's value, or that of another, from a file; nothing else is computed again."""
        np.save(tmp_path / "f.npy", np.full((2, 2), 5.0))
        assert "s is replaced by f.npy" in ask("s", "replace f.npy", "c")
        np.testing.assert_array_equal(ask.result["s"], np.full((2, 2), 5.0))  # type: ignore[attr-defined]
        ask("p", "replace grid f.npy", "c", "c")
        np.testing.assert_array_equal(ask.result["s"], np.full((2, 2), 10.0))  # type: ignore[attr-defined]


class TestMistakes:
    @pytest.mark.parametrize(
        ("command", "said"),
        [
            ("valeu", "did you mean 'value'"),
            ("show", "say it as: show NAME [FILE]"),
            ("show grid a.png more", "say it as"),
            ("show nothing", "there is grid"),
            ("show grid.low a.png", "has no field 'low'"),
            ("show grid /dev/null/a.png", "cannot be written"),
            ("show grid a.xyz", ".png"),
            ('save grid "a', "no closing quotation"),
            ("save grid a.xyz", "can be written"),
            ("replace nothing.npy", "No such file"),
            ("replace nothing 3", "no node or input"),
            ("replace grid", "read from .npy"),
            ("replace p.low 3", "name the whole node"),
            ("!", "no command"),
            ("   ", ""),
        ],
    )
    def test_a_line(self, ask: Ask, command: str, said: str) -> None:
        """A mistake is answered in a line, and the run still stands there."""
        out = ask("s", command, "inputs", "c")
        assert (f"error: {out.partition('error: ')[2].partition(chr(10))[0]}" in out and said in out) or not said
        assert "grid <- p.low" in out


class TestGoesOn:
    def test_next(self, ask: Ask) -> None:
        """`next` stands before the node that runs next."""
        assert "before p (toy.pair)" in ask("g", "n", "c")

    @pytest.mark.parametrize("commands", [["quit"], ["q"], []])
    def test_quit(self, ask: Ask, commands: list[str]) -> None:
        """`quit`, and the end of what is piped in, end the run."""
        with pytest.raises(StopRun, match="no output was written"):
            ask("g", *commands)

    def test_pdb(self, ask: Ask) -> None:
        """pdb stands in the operator's function with its real arguments; the run's own call is not touched."""
        out = ask("s", "pdb", "p grid.sum()", "c", "c")
        assert "toys.py" in out
        assert "16.0" in out
        assert "it gave float64[4, 4] 2..2" in out
        assert ask.result["s"].max() == 2  # type: ignore[attr-defined]

    def test_pdb_left(self, ask: Ask) -> None:
        """Leaving pdb leads back to the prompt."""
        assert "grid <- p.low" in ask("s", "pdb", "q", "inputs", "c")

    def test_pdb_failure(self, ask: Ask, capsys: pytest.CaptureFixture[str]) -> None:
        """A function that raises is looked at where it did."""
        with pytest.raises(RunFailed):
            ask("bad", "pdb", "c", "p message", "q", "c", outputs=["bad"])
        out = capsys.readouterr().out
        assert "it raised ValueError: it broke" in out
        assert "'it broke'" in out
