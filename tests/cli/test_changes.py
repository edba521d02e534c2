"""Files are seen to change, once for each change, and only when nobody is writing to them any more."""

import os
import time
from pathlib import Path

import pytest

from graphface.cli import changes
from graphface.cli.changes import ChangingFiles


@pytest.fixture
def files(tmp_path: Path) -> ChangingFiles:
    (tmp_path / "a").write_text("1")
    watched = ChangingFiles()
    watched.watch([tmp_path / "a", tmp_path / "b"], time.time_ns())
    return watched


class TestTaken:
    def test_once(self, files: ChangingFiles, tmp_path: Path) -> None:
        """A change is told once."""
        assert files.taken() == []
        (tmp_path / "a").write_text("22")
        assert files.taken() == [tmp_path / "a"]
        assert files.taken() == []

    def test_made_and_deleted(self, files: ChangingFiles, tmp_path: Path) -> None:
        """A file that was not there yet is watched too, and one that goes away has changed."""
        (tmp_path / "b").write_text("1")
        (tmp_path / "a").unlink()
        assert set(files.taken()) == {tmp_path / "a", tmp_path / "b"}

    def test_replaced_by_an_older_one(self, files: ChangingFiles, tmp_path: Path) -> None:
        """An editor that renames another file into place changes it, whatever that file's time is."""
        (tmp_path / "new").write_text("3")
        os.utime(tmp_path / "new", (1, 1))
        os.replace(tmp_path / "new", tmp_path / "a")
        assert files.taken() == [tmp_path / "a"]

    def test_watched_again(self, files: ChangingFiles, tmp_path: Path) -> None:
        """A change during a run is not lost by watching the same file for the next one."""
        (tmp_path / "a").write_text("22")
        files.watch([tmp_path / "a"], time.time_ns())
        assert files.taken() == [tmp_path / "a"]

    def test_new_and_written_meanwhile(self, files: ChangingFiles, tmp_path: Path) -> None:
        """A file that is watched from now on, and was written to after it was read, counts as changed."""
        (tmp_path / "c").write_text("1")
        files.watch([tmp_path / "c"], since=0)
        assert files.taken() == [tmp_path / "c"]


class TestWait:
    def test_settles(self, files: ChangingFiles, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
        """While a file is being written, nothing is told."""
        texts = ["x" * count for count in range(2, 6)]

        def sleep(seconds: float) -> None:
            if texts:
                (tmp_path / "a").write_text(texts.pop(0))

        monkeypatch.setattr(changes.time, "sleep", sleep)
        assert files.wait() == [tmp_path / "a"]
        assert (tmp_path / "a").read_text() == "xxxxx"

    def test_gone_for_a_moment(self, files: ChangingFiles, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
        """A file that an editor takes away and puts back has changed when it is there again."""
        (tmp_path / "a").unlink()
        slept: list[float] = []

        def sleep(seconds: float) -> None:
            slept.append(seconds)
            if len(slept) == 3:
                (tmp_path / "a").write_text("back")

        monkeypatch.setattr(changes.time, "sleep", sleep)
        assert files.wait() == [tmp_path / "a"]
        assert (tmp_path / "a").exists()
