"""Which files are written beside a run's outputs."""

from pathlib import Path

import pytest

from graphface.cli.beside import Beside
from graphface.cli.dump_folder import DumpFolder
from graphface.cli.failure_file import FailureFile
from graphface.cli.following import TraceFile
from graphface.cli.report_file import ReportFile
from graphface.errors import UsageError
from graphface.evaluate.evaluator import Evaluator

FILE = Path("somewhere")
NOTHING = Beside(None, False, None, 256, None, None)
ALL = Beside(FILE, False, FILE, 256, FILE, FILE)


class TestFollowers:
    def test_nothing(self) -> None:
        """Without flags nothing follows the run."""
        assert NOTHING.followers(Evaluator()) == []

    def test_each(self) -> None:
        """Every flag gives its follower."""
        kinds = [type(follower) for follower in ALL.followers(Evaluator())]
        assert kinds == [TraceFile, ReportFile, DumpFolder, FailureFile]


class TestCheck:
    def test_peaks(self) -> None:
        """Peaks of memory are measured for a trace only."""
        with pytest.raises(UsageError, match="add --trace"):
            Beside(None, True, None, 256, None, None).check([])

    def test_maps(self) -> None:
        """What follows one run is refused where several are asked for, by name."""
        with pytest.raises(UsageError, match="--trace, --report, --dump, --save-failure: follows one run"):
            ALL.check(["photo=folder"])
        NOTHING.check(["photo=folder"])
        ALL.check([])
