"""What is written beside a run: refused early, written always."""

from pathlib import Path

import pytest

from graphface.cli.following import Follower, TraceFile, written
from graphface.errors import UsageError


class Note(Follower):
    def __init__(self, said: list[str], name: str, wrong: bool = False) -> None:
        self.said, self.name, self.wrong = said, name, wrong

    def check(self) -> None:
        self.said.append(f"check {self.name}")
        if self.wrong:
            raise UsageError("cannot be written")

    def write(self) -> None:
        self.said.append(f"write {self.name}")

    def stopped(self, error: BaseException) -> None:
        self.said.append(f"stopped {self.name} {type(error).__name__}")


class TestWritten:
    def test_order(self) -> None:
        """All are checked before the run, and written after it in their order."""
        said: list[str] = []
        with written([Note(said, "a"), Note(said, "b")]):
            said.append("run")
        assert said == ["check a", "check b", "run", "write a", "write b"]

    def test_failed_run(self) -> None:
        """A run that fails is written too, when it is known why."""
        said: list[str] = []
        with pytest.raises(KeyboardInterrupt), written([Note(said, "a")]):
            raise KeyboardInterrupt
        assert said[-2:] == ["stopped a KeyboardInterrupt", "write a"]

    def test_refused(self) -> None:
        """Where one cannot be written, nothing runs and nothing is written."""
        said: list[str] = []
        with pytest.raises(UsageError), written([Note(said, "a"), Note(said, "b", wrong=True)]):
            said.append("run")
        assert said == ["check a", "check b"]


def test_trace_folder(tmp_path: Path) -> None:
    """A trace that cannot be written is refused before anything runs."""
    (tmp_path / "file").touch()
    with pytest.raises(UsageError, match="cannot be written"):
        TraceFile(tmp_path / "file" / "run.json", peaks=False).check()
