"""Killed, interrupted or crowded: a cache folder stays valid, nothing wrong is served, and a rerun takes up the rest.

`GRAPHFACE_KILLS=200 pytest tests/stability/test_kill.py` runs the long version.
"""

from __future__ import annotations

import json
import os
import random
import signal
import subprocess
import sys
import time
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest
from interrupts import HEARD

from graphface.cache.disk import DiskTier

sys.path.insert(0, os.path.dirname(__file__))
import killed

KILLS = int(os.environ.get("GRAPHFACE_KILLS", "15"))
SCRIPT = Path(killed.__file__)

pytestmark = pytest.mark.skipif(sys.platform == "win32", reason="signals of POSIX")


class TestKill:
    @pytest.fixture
    def spawner(self, tmp_path: Path) -> Iterator[subprocess.Popen[str]]:
        """A process that forks a child at work on tmp_path/cache for every line written to it."""
        command = [sys.executable, str(SCRIPT), str(tmp_path / "cache"), "spawn"]
        with subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True) as process:
            yield process
            assert process.stdin is not None
            process.stdin.close()
            assert process.wait(20) == 0

    def test_at_random_moments(self, spawner: subprocess.Popen[str], tmp_path: Path) -> None:
        """Killed with SIGKILL at random moments of runs that store, read and evict, every later read is right."""
        assert spawner.stdin is not None
        assert spawner.stdout is not None
        chance = random.Random(0)
        said: list[str] = []
        for number in range(KILLS):
            print(number, file=spawner.stdin, flush=True)
            child = int(spawner.stdout.readline())
            time.sleep(chance.uniform(0, 0.12))
            os.kill(child, signal.SIGKILL)
            assert int(spawner.stdout.readline()) == signal.SIGKILL, "the child ended by itself: a wrong value"
            for seed in range(6):
                killed.check(tmp_path / "cache", seed, said)
        report = DiskTier(tmp_path / "cache", killed.BUDGET).verify()
        assert report.intact > 0
        assert not report.foreign
        assert all("dropped" in message for message in said)

    def test_eight_at_once(self, tmp_path: Path) -> None:
        """Eight processes that run the same graph on one folder all get right values and report nothing."""
        command = [sys.executable, str(SCRIPT), str(tmp_path / "cache")]
        running = [
            subprocess.Popen([*command, str(seed), "12"], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
            for seed in range(8)
        ]
        said = [process.communicate(timeout=120)[0] for process in running]
        assert [process.returncode for process in running] == [0] * 8, said
        assert said == [""] * 8
        report = DiskTier(tmp_path / "cache", killed.BUDGET).verify()
        assert (report.damaged, report.unfinished, report.foreign) == ([], [], [])


PLUGIN = """\
import time
from pathlib import Path

import numpy as np

from graphface import node


@node("slow.start")
def start() -> np.ndarray:
    return np.zeros(1000)


@node("slow.step")
def step(a: np.ndarray, *, mark: str) -> np.ndarray:
    Path(mark).touch()
    time.sleep(0.2)
    return a + 1
"""

STEPS = 8


class Slow:
    """`graphface run` on a chain of slow nodes, each of which leaves a file when it begins."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        (folder / "slow.py").write_text(PLUGIN)
        lines = ["graphface: 1", "name: slow", "nodes:", "  start: {use: slow.start}"]
        for i in range(STEPS):
            above = f"s{i - 1}" if i else "start"
            lines.append(f"  s{i}: {{use: slow.step, in: {{a: {above}}}, with: {{mark: {self.mark(i)}}}}}")
        (folder / "slow.yaml").write_text("\n".join([*lines, f"outputs: {{last: s{STEPS - 1}}}"]) + "\n")

    def mark(self, number: int) -> Path:
        return self.folder / f"mark{number}"

    def start(self, *flags: str) -> subprocess.Popen[str]:
        code = f"{HEARD}; from graphface.cli import main; main()"
        command = [sys.executable, "-c", code, "run", f"{self.folder}/slow.yaml"]
        command += ["--plugin", f"{self.folder}/slow.py", "--cache", f"{self.folder}/cache"]
        command += ["--trace", f"{self.folder}/run.json", "-o", f"last={self.folder}/last.npy", *flags]
        return subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)

    def wait_for(self, number: int, process: subprocess.Popen[str]) -> None:
        """Until a step has begun; a process that ended before fails the test."""
        for _ in range(3000):
            if self.mark(number).exists():
                return
            assert process.poll() is None, process.communicate()[1]
            time.sleep(0.01)
        pytest.fail(f"step {number} never began")

    def states(self) -> dict[str, str]:
        """What the last trace says became of each node."""
        return {entry["name"]: entry["state"] for entry in json.loads((self.folder / "run.json").read_text())["nodes"]}


class TestInterrupt:
    @pytest.mark.parametrize("threads", ["1", "2"])
    def test_ctrl_c(self, tmp_path: Path, threads: str) -> None:
        """Ctrl-C ends with exit code 130 and one line, leaves a valid cache, and the rerun runs only the rest."""
        slow = Slow(tmp_path)
        process = slow.start("--threads", threads)
        slow.wait_for(4, process)
        process.send_signal(signal.SIGINT)
        said = process.communicate(timeout=30)[1]
        assert process.returncode == 130
        assert said == "error: interrupted; what was computed is kept where a cache is in use\n"
        assert not slow.mark(6).exists()
        assert not (tmp_path / "last.npy").exists()
        assert not DiskTier(tmp_path / "cache", 1 << 20).verify().damaged
        before = {name for name, state in slow.states().items() if state == "ran"}
        assert before >= {"start", "s0", "s1", "s2", "s3"}

        process = slow.start("--threads", threads)
        assert (process.communicate(timeout=60)[1], process.returncode) == ("", 0)
        after = {name for name, state in slow.states().items() if state == "ran"}
        assert after == {f"s{i}" for i in range(STEPS)} - before
        assert (np.load(tmp_path / "last.npy") == STEPS).all()
