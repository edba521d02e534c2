"""What a command does beside a run: a trace, a report, a folder of values. Each is an observer that writes a file."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import ExitStack, contextmanager
from pathlib import Path

from graphface.evaluate.observe import Observer
from graphface.report.trace import Trace
from graphface.values.writing import check_folder


class Follower(Observer):
    """An observer of one run with something to write at its end: `what`, to `path` where that is one file."""

    what: str = ""
    path: Path | None = None

    def check(self) -> None:
        """See before anything runs that the result could be written.

        Raises:
            UsageError: it could not.
        """

    def stopped(self, error: BaseException) -> None:
        """The run ended with an error, which is raised when everything is written."""

    def write(self) -> None:
        """Write what was followed; called once, also where the run failed or was interrupted."""


class TraceFile(Trace, Follower):
    """`--trace run.json`."""

    what = "--trace"

    def __init__(self, path: Path, *, peaks: bool) -> None:
        super().__init__(peaks=peaks)
        self.path: Path = path

    def check(self) -> None:
        check_folder(self.path)

    def write(self) -> None:
        self.write_to(self.path)


@contextmanager
def written(followers: Sequence[Follower]) -> Iterator[None]:
    """Inside the block a run is followed; after it everything is written, whatever happened in the block."""
    for follower in followers:
        follower.check()
    with ExitStack() as stack:
        for follower in reversed(followers):
            stack.callback(follower.write)
        try:
            yield
        except BaseException as error:
            for follower in followers:
                follower.stopped(error)
            raise
