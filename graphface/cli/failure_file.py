"""`graphface run --save-failure`."""

from __future__ import annotations

import sys
from pathlib import Path

from graphface.cli.following import Follower
from graphface.errors import UnwritableFile, UsageError
from graphface.fallback import warn
from graphface.report.failure import FirstFailure, write_failure
from graphface.values.writing import check_folder


class FailureFile(FirstFailure, Follower):
    """`--save-failure FILE.zip`: written only where a node fails."""

    what = "--save-failure"

    def __init__(self, path: Path) -> None:
        super().__init__()
        self.path: Path = path

    def check(self) -> None:
        check_folder(self.path)
        if self.path.suffix.lower() != ".zip":
            raise UsageError(f"--save-failure {self.path}: the name ends in .zip")

    def write(self) -> None:
        if self.failed is None:
            return
        try:
            write_failure(self.failed, self.path)
        except UnwritableFile as error:
            warn(f"the failure is not saved: {error}")
        else:
            print(f"node {self.failed.step.name!r} is in {self.path}: graphface replay {self.path}", file=sys.stderr)
