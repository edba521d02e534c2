"""What operators took before is a guess that helps a progress bar and never stands in anybody's way."""

import json
import math
from pathlib import Path

import platformdirs
import pytest
from hypothesis import given
from hypothesis import strategies as st

from graphface.record import Record
from graphface.report.timings import Timings


@pytest.fixture(autouse=True)
def file(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """The file of timings, in a cache folder of this test alone."""
    monkeypatch.setattr(platformdirs, "user_cache_path", lambda name: tmp_path / "caches" / name)
    return tmp_path / "caches" / "graphface" / "timings.json"


def ran(operator: str, seconds: float, state: str = "ran") -> Record:
    return Record("node", operator, state, b"", seconds)  # type: ignore[arg-type]


class TestExpected:
    def test_unknown(self) -> None:
        """An operator never seen is expected to take some time: it has a share of the bar."""
        assert Timings.load().expected("toy.add") > 0

    def test_learned(self) -> None:
        """After one run it is what that took, in this process and the next."""
        timings = Timings.load()
        timings.learn([ran("toy.add", 2.0)])
        assert timings.expected("toy.add") == 2.0
        assert Timings.load().expected("toy.add") == 2.0

    def test_running_mean(self) -> None:
        """One slow run moves the expectation part of the way, many the whole way."""
        timings = Timings.load()
        timings.learn([ran("toy.add", 1.0)])
        timings.learn([ran("toy.add", 2.0)])
        assert 1.0 < timings.expected("toy.add") < 2.0
        for _ in range(50):
            timings.learn([ran("toy.add", 2.0)])
        assert timings.expected("toy.add") == pytest.approx(2.0, abs=1e-3)

    def test_only_what_ran(self, file: Path) -> None:
        """A memoized, failed or declined node says nothing about its operator's time."""
        timings = Timings.load()
        timings.learn([ran("toy.add", 5.0, state) for state in ("memory", "disk", "failed", "blocked", "declined")])
        assert timings.expected("toy.add") == Timings().expected("toy.add")
        assert not file.exists()


class TestFile:
    @pytest.mark.parametrize("text", ["", "[", "[]", "3", '{"a": "b"}', '{"a": null}', "\x00", '{"a": [1]}'])
    def test_unreadable(self, file: Path, text: str) -> None:
        """A damaged file is as good as none, and the next run writes a good one."""
        file.parent.mkdir(parents=True)
        file.write_text(text)
        timings = Timings.load()
        timings.learn([ran("toy.add", 1.0)])
        assert json.loads(file.read_text()) == {"toy.add": 1.0}

    @pytest.mark.parametrize("text", ['{"toy.add": NaN}', '{"toy.add": -5}', '{"toy.add": Infinity}', '{"toy.add": 0}'])
    def test_absurd(self, file: Path, text: str) -> None:
        """Absurd times are not believed: a bar's total stays positive and finite."""
        file.parent.mkdir(parents=True)
        file.write_text(text)
        assert 0 <= Timings.load().expected("toy.add") < math.inf

    def test_unwritable(self, file: Path) -> None:
        """Where it cannot be written, nothing happens."""
        file.parent.parent.mkdir(parents=True)
        file.parent.write_text("a file where the folder should be")
        Timings.load().learn([ran("toy.add", 1.0)])

    def test_two_processes(self, file: Path) -> None:
        """The file is replaced whole; nothing else is left in its folder."""
        for seconds in (1.0, 2.0, 3.0):
            Timings.load().learn([ran("toy.add", seconds)])
        assert [found.name for found in file.parent.iterdir()] == ["timings.json"]

    @given(st.lists(st.floats(0, 1e6), min_size=1, max_size=20))
    def test_bounds(self, seconds: list[float]) -> None:
        """The expectation lies between the shortest and the longest run seen."""
        timings = Timings()
        timings._store = lambda: None  # type: ignore[method-assign]
        for took in seconds:
            timings.learn([ran("toy.add", took)])
        assert min(seconds) - 1e-5 <= timings.expected("toy.add") <= max(seconds) + 1e-5
