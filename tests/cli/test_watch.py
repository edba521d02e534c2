"""`run --watch` runs again after every edit, says why in a line, and outlives what is broken."""

import os
import signal
import subprocess
import sys
import time
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest
import toys
from interrupts import HEARD

PROGRAM = "from graphface.cli import main; main()"
PACK = """
from graphface import node

@node("mine.number")
def number(*, value: float = 1.0) -> float:
    return value

@node("mine.double")
def double(a: float) -> float:
    return a * 2
"""


class Watching:
    """A watching process, and what it said."""

    def __init__(self, folder: Path, *arguments: str, path: str = "") -> None:
        self.folder = folder
        self.log = folder / "log.txt"
        environment = {**os.environ, "PYTHONPATH": os.pathsep.join([path, *sys.path])}
        environment["TMPDIR"] = str(folder)
        with self.log.open("w") as log:
            command = [sys.executable, "-c", f"{HEARD}; {PROGRAM}", "run", *arguments, "--watch"]
            self.process = subprocess.Popen(command, cwd=folder, env=environment, stdout=log, stderr=log)

    def says(self, words: str, count: int = 1) -> str:
        """Wait until it said this so many times; the last line of it."""
        for _ in range(600):
            found = [line for line in self.log.read_text().splitlines() if words in line]
            if len(found) >= count:
                return found[-1]
            assert self.process.poll() is None, self.log.read_text()
            time.sleep(0.05)
        raise AssertionError(f"never said {words!r}: {self.log.read_text()}")

    def end(self) -> int:
        self.process.send_signal(signal.SIGINT)
        code = self.process.wait(20)
        assert "Traceback" not in self.log.read_text()
        return code


@pytest.fixture
def folder(tmp_path: Path, graph: Path) -> Path:
    (tmp_path / "h.yaml").write_text("graphface: 1\nextends: g.yaml\nnodes:\n  s: {with: {by: 4}}\n")
    return tmp_path


def edit(path: Path, old: str, new: str) -> None:
    text = path.read_text()
    assert old in text
    path.write_text(text.replace(old, new))


@pytest.fixture
def quiet(folder: Path) -> Iterator[Watching]:
    process = Watching(folder, "h.yaml", "--plugin", toys.__file__, "-o", "o.npy")
    yield process
    process.process.kill()
    process.process.wait()


class TestGraphs:
    def test_session(self, quiet: Watching, folder: Path) -> None:
        """Edits of the graph and of what it extends are run, a broken one is waited out, Ctrl-C is no error."""
        assert "2 of 2 nodes ran" in quiet.says("first run")
        edit(folder / "h.yaml", "by: 4", "by: 5")
        assert "1 of 2 nodes ran" in quiet.says("parameter by of s 4.0 -> 5.0")
        assert np.load(folder / "o.npy").max() == 5
        edit(folder / "g.yaml", "g: {use: toy.grid}", "g: {use: toy.grid, with: {fill: [}}")
        assert "g.yaml:5:" in quiet.says("not YAML")
        assert np.load(folder / "o.npy").max() == 5
        edit(folder / "g.yaml", "fill: [", "fill: 2")
        quiet.says("parameter fill of g 1.0 -> 2.0")
        assert np.load(folder / "o.npy").max() == 10
        os.utime(folder / "h.yaml")
        quiet.says("0 of 2 nodes ran")
        assert quiet.end() == 0
        assert "no longer watching" in quiet.log.read_text()
        assert np.load(folder / "o.npy").max() == 10

    def test_broken_from_the_start(self, folder: Path) -> None:
        """A graph that is wrong when watching begins is waited for."""
        edit(folder / "h.yaml", "by: 4", "bye: 4")
        process = Watching(folder, "h.yaml", "--plugin", toys.__file__, "-o", "o.npy")
        try:
            process.says("no parameter 'bye'")
            edit(folder / "h.yaml", "bye: 4", "by: 4")
            process.says("first run")
            assert process.end() == 0
        finally:
            process.process.kill()


class TestCode:
    def test_plugin(self, folder: Path) -> None:
        """An edited plug-in runs at once in the same process; one that cannot be parsed is told with its line."""
        (folder / "scale.py").write_text(
            "import numpy as np\nfrom graphface import node\n\n"
            '@node("my.full")\ndef full(*, fill: float = 1.0) -> np.ndarray:\n    return np.full((2, 2), fill)\n'
        )
        (folder / "n.yaml").write_text("graphface: 1\nnodes:\n  f: {use: my.full}\noutputs: {f: f}\n")
        process = Watching(folder, "n.yaml", "--plugin", "scale.py", "-o", "o.npy")
        try:
            process.says("first run")
            for number in (2, 3, 4):  # within a second, and of one size
                edit(
                    folder / "scale.py", "fill)\n" if number == 2 else f"fill + {number - 1})\n", f"fill + {number})\n"
                )
                process.says("the code of my.full changed", number - 1)
                assert np.load(folder / "o.npy").max() == number + 1
            assert "afresh" not in process.log.read_text()
            edit(folder / "scale.py", "def full(*", "def full((*")
            assert "scale.py:5:" in process.says("error: ")
            edit(folder / "scale.py", "def full((*", "def full(*")
            process.says("0 of 1 nodes ran")
            assert process.end() == 0
        finally:
            process.process.kill()

    def test_module_of_a_pack(self, folder: Path) -> None:
        """An edited module begins a fresh process, which has the values of the old one and leaves no folder."""
        package = folder / "site"
        (package / "mine-1.0.dist-info").mkdir(parents=True)
        (package / "mine-1.0.dist-info" / "METADATA").write_text("Metadata-Version: 2.1\nName: mine\nVersion: 1.0\n")
        (package / "mine-1.0.dist-info" / "entry_points.txt").write_text("[graphface.nodes]\nmine = mine\n")
        (package / "mine.py").write_text(PACK + "\n\nfrom mine_helper import FACTOR\n")
        (package / "mine_helper.py").write_text("FACTOR = 1\n")
        (folder / "plug2.py").write_text(
            "import numpy as np\nfrom graphface import node\n\n"
            '@node("my.full")\ndef full(fill: float) -> np.ndarray:\n    return np.full((2, 2), fill)\n'
        )
        (folder / "n.yaml").write_text(
            "graphface: 1\nnodes:\n  a: {use: mine.number}\n  b: {use: mine.double, in: {a: a}}\n"
            "  f: {use: my.full, in: {fill: b}}\n  k: {use: my.full, in: {fill: x}}\n"
            "inputs: {x: {type: float, default: 3}}\noutputs: {f: f, k: k}\n"
        )
        process = Watching(
            folder, "n.yaml", "--plugin", "plug2.py", "-o", "f=o.npy", "-o", "k=k.npy", path=str(package)
        )
        try:
            assert "4 of 4" in process.says("first run")
            edit(package / "mine.py", "a * 2", "a * (2")
            assert "mine.py:" in process.says("error: ")
            edit(package / "mine.py", "a * (2", "a * 7")
            process.says("starting afresh")
            assert "3 of 4 nodes ran" in process.says("the code of mine.number, mine.double changed")
            assert np.load(folder / "o.npy").max() == 7
            edit(package / "mine.py", "import FACTOR", "import FACTOR, NONE")
            process.says("error: ", 2)
            edit(package / "mine.py", "import FACTOR, NONE", "import FACTOR")
            process.says("starting afresh", 3)
            process.says("nodes ran", 3)
            assert process.end() == 0
            assert [p.name for p in folder.glob("graphface-watch-*")] == []
        finally:
            process.process.kill()


class TestRefused:
    def test_map(self, graphface: object, graph: Path, plugin: list[str]) -> None:
        """It is about one run."""
        assert graphface("run", graph, *plugin, "-o", "o.npy", "--watch", "--map", "x=.").code == 2  # type: ignore[operator]
