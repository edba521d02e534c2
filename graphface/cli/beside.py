"""What `graphface run` may write beside its outputs, as its flags say."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from graphface.cli.following import Follower, TraceFile
from graphface.errors import UsageError
from graphface.evaluate.evaluator import Evaluator


@dataclass(frozen=True)
class Beside:
    """The flags of one run, None where they are left out; `peaks` belongs to the trace, `report_size` to the report."""

    trace: Path | None
    peaks: bool
    report: Path | None
    report_size: int
    dump: Path | None
    save_failure: Path | None

    def check(self, maps: Sequence[str]) -> None:
        """Refuse flags that do not go together.

        Raises:
            UsageError: some follow one run, and `maps` asks for several; or peaks are measured for no trace.
        """
        if self.peaks and self.trace is None:
            raise UsageError("--peaks is measured for the trace; add --trace run.json")
        files = {
            "--trace": self.trace,
            "--report": self.report,
            "--dump": self.dump,
            "--save-failure": self.save_failure,
        }
        asked = [flag for flag, path in files.items() if path is not None]
        if maps and asked:
            raise UsageError(f"{', '.join(asked)}: follows one run; leave it out with --map")

    def followers(self, evaluator: Evaluator) -> list[Follower]:
        """What follows a run of this evaluator; only what is asked for is imported."""
        followers: list[Follower] = [TraceFile(self.trace, peaks=self.peaks)] if self.trace is not None else []
        if self.report is not None:
            from graphface.cli.report_file import ReportFile

            followers.append(ReportFile(self.report, self.report_size, evaluator.find))
        if self.dump is not None:
            from graphface.cli.dump_folder import DumpFolder

            followers.append(DumpFolder(self.dump, evaluator))
        if self.save_failure is not None:
            from graphface.cli.failure_file import FailureFile

            followers.append(FailureFile(self.save_failure))
        return followers
