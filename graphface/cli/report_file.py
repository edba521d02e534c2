"""`graphface run --report`."""

from __future__ import annotations

from pathlib import Path

from graphface.cli.following import Follower
from graphface.report.page.html import check_report, write_report
from graphface.report.recorder import Find, Recorder


class ReportFile(Recorder, Follower):
    """`--report run.html`."""

    what = "--report"

    def __init__(self, path: Path, size: int, find: Find) -> None:
        super().__init__(find, size)
        self.path: Path = path

    def check(self) -> None:
        check_report(self.path)

    def stopped(self, error: BaseException | None) -> None:
        Recorder.stopped(self, error)

    def write(self) -> None:
        write_report(self, self.path)
