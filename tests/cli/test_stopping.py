"""`run --break` asks at a node: typed in or piped in, and never past the user."""

import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

Scripted = Callable[..., subprocess.CompletedProcess[str]]
PROGRAM = "from graphface.cli import main; main()"


@pytest.fixture
def scripted(graph: Path, plugin: list[str], tmp_path: Path) -> Scripted:
    """`graphface run` in a process of its own, with commands piped in."""

    def run(commands: str, *arguments: str) -> subprocess.CompletedProcess[str]:
        command = [sys.executable, "-c", PROGRAM, "run", str(graph), *plugin, "-o", "o.npy", *arguments]
        done = subprocess.run(command, input=commands, cwd=tmp_path, capture_output=True, text=True, timeout=60)
        assert "Traceback" not in done.stderr + done.stdout
        return done

    return run


class TestBreak:
    def test_session(self, scripted: Scripted, tmp_path: Path) -> None:
        """A scripted session reads like a typed one, and its replaced value is in the output."""
        np.save(tmp_path / "f.npy", np.full((2, 2), 5.0))
        done = scripted("inputs\nshow grid g.png\nnope\nreplace grid f.npy\ncontinue\n", "--break", "s")
        assert done.returncode == 0
        for words in ("before s (toy.scale), ", "(s) inputs", "grid <- g: float64[4, 4]", "error: no command 'nope'"):
            assert words in done.stdout
        assert done.stdout.count("before s (toy.scale)") == 2
        np.testing.assert_array_equal(np.load(tmp_path / "o.npy"), np.full((2, 2), 15.0))
        assert (tmp_path / "g.png").is_file()

    @pytest.mark.parametrize("commands", ["quit\n", ""])
    def test_quit(self, scripted: Scripted, tmp_path: Path, commands: str) -> None:
        """Leaving, and the end of what is piped in, write nothing and are no success."""
        done = scripted(commands, "--break", "s:after")
        assert done.returncode == 1
        assert "stopped after node 's'; no output was written" in done.stderr
        assert not (tmp_path / "o.npy").exists()

    def test_cached(self, scripted: Scripted, tmp_path: Path) -> None:
        """A node whose value is in the cache folder stops all the same; what is above it comes from there."""
        scripted("", "--cache", "c")
        done = scripted("next\ncontinue\n", "--cache", "c", "--break", "s")
        assert "before s" in done.stdout
        done = scripted("continue\n", "--cache", "c", "--break", "g")
        assert "before g" in done.stdout

    def test_threads(self, scripted: Scripted) -> None:
        """One thread; who asked for more is told."""
        assert "one thread, not 3" in scripted("c\n", "--break", "s", "--threads", "3").stderr
        assert "thread" not in scripted("c\n", "--break", "s").stderr

    @pytest.mark.parametrize("node", ["nothing", "s:aftr", "x", "s.by"])
    def test_refused(self, scripted: Scripted, node: str) -> None:
        """What is no node of the graph is refused before anything runs."""
        assert scripted("c\n", "--break", node).returncode == 2

    def test_not_with(self, scripted: Scripted) -> None:
        """It is about one run."""
        assert scripted("", "--break", "s", "--watch").returncode == 2
        assert scripted("", "--break", "s", "--map", "x=.").returncode == 2


class TestPin:
    def test_file(self, graphface: Callable[..., object], graph: Path, plugin: list[str], tmp_path: Path) -> None:
        """`--pin` puts a file in a node's place, in `run`, `plan` and `explain`."""
        np.save(tmp_path / "f.npy", np.full((2, 2), 5.0))
        pin = ("--pin", f"g={tmp_path / 'f.npy'}")
        assert graphface("run", graph, *plugin, "-o", tmp_path / "o.npy", *pin).code == 0
        np.testing.assert_array_equal(np.load(tmp_path / "o.npy"), np.full((2, 2), 15.0))
        for command in ("plan", "explain"):
            assert "pinned" in graphface(command, graph, *plugin, *pin).out

    @pytest.mark.parametrize("pin", ["g", "nothing=f.npy", "g=absent.npy", "x=3", "g=3"])
    def test_refused(self, graphface: Callable[..., object], graph: Path, plugin: list[str], pin: str) -> None:
        """A wrong node, file or form is refused."""
        assert graphface("run", graph, *plugin, "-o", "o.npy", "--pin", pin).code == 2

    def test_not_overwritten(
        self, graphface: Callable[..., object], graph: Path, plugin: list[str], tmp_path: Path
    ) -> None:
        """A result is never written over the file that was pinned."""
        np.save(tmp_path / "f.npy", np.full((2, 2), 5.0))
        pinned = ("--pin", f"g={tmp_path / 'f.npy'}")
        assert graphface("run", graph, *plugin, "-o", tmp_path / "f.npy", *pinned).code == 2
