"""What a command does beside a run: a trace, a report, a folder of values. Each is an observer that writes a file."""

from __future__ import annotations

import sys
from collections.abc import Iterator, Sequence
from contextlib import ExitStack, contextmanager
from pathlib import Path

from graphface.errors import UnwritableFile, UsageError
from graphface.evaluate.observe import Observer
from graphface.fallback import warn
from graphface.report.dump import Dump
from graphface.report.failure import FirstFailure, write_failure
from graphface.report.trace import Trace
from graphface.values.writing import check_folder


class Follower(Observer):
    """An observer of one run with something to write at its end."""

    def check(self) -> None:
        """See before anything runs that the result could be written.

        Raises:
            UsageError: it could not.
        """

    def write(self) -> None:
        """Write what was followed; called once, also where the run failed or was interrupted."""


class TraceFile(Trace, Follower):
    """`--trace run.json`."""

    def __init__(self, path: Path, *, peaks: bool) -> None:
        super().__init__(peaks=peaks)
        self._path = path

    def check(self) -> None:
        check_folder(self._path)

    def write(self) -> None:
        self.write_to(self._path)


class FailureFile(FirstFailure, Follower):
    """`--save-failure FILE.zip`: written only where a node fails."""

    def __init__(self, path: Path) -> None:
        super().__init__()
        self._path = path

    def check(self) -> None:
        check_folder(self._path)
        if self._path.suffix.lower() != ".zip":
            raise UsageError(f"--save-failure {self._path}: the name ends in .zip")

    def write(self) -> None:
        if self.failed is None:
            return
        try:
            write_failure(self.failed, self._path)
        except UnwritableFile as error:
            warn(f"the failure is not saved: {error}")
        else:
            print(f"node {self.failed.step.name!r} is in {self._path}: graphface replay {self._path}", file=sys.stderr)


class DumpFolder(Dump, Follower):
    """`--dump DIR`."""


@contextmanager
def written(followers: Sequence[Follower]) -> Iterator[None]:
    """Inside the block a run is followed; after it everything is written, whatever happened in the block."""
    for follower in followers:
        follower.check()
    with ExitStack() as stack:
        for follower in reversed(followers):
            stack.callback(follower.write)
        yield
