"""What a watching process leaves to the one that takes its place: values, history, and the files to watch."""

from __future__ import annotations

import json
import os
import shutil
import sys
import tempfile
from collections.abc import Iterable
from pathlib import Path
from typing import TYPE_CHECKING, NoReturn

if TYPE_CHECKING:
    from graphface.cache.disk import DiskTier
    from graphface.evaluate.evaluator import Evaluator
    from graphface.evaluate.observe import Observer
    from graphface.graph.request import Request
    from graphface.report.history import History

_VARIABLE = "GRAPHFACE_WATCH"
"""Names the folder to the process that takes over."""


class Succession:
    """The folder between two processes, from the first's end to the first run of the second.

    Attributes:
        files: modules that the process before watched: where one of them is broken, nobody here knows of it.
    """

    def __init__(self, evaluator: Evaluator) -> None:
        named = os.environ.pop(_VARIABLE, "")
        self._folder: Path | None = Path(named) if named and (Path(named) / "files.json").is_file() else None
        self._evaluator = evaluator
        self.files: set[Path] = set()
        if self._folder is not None:
            self.files = {Path(name) for name in json.loads((self._folder / "files.json").read_text(encoding="utf-8"))}

    def heir(self, history: History) -> Observer:
        """An observer that takes over what was left, when the first run starts."""
        from graphface.evaluate.observe import Observer

        succession = self

        class Heir(Observer):
            def run_started(self, request: Request) -> None:
                succession._take_over(request, history)

        return Heir()

    def hand_over(self, last: Request | None, history: History, files: Iterable[Path]) -> NoReturn:
        """Leave everything behind and become a fresh process with the same command line."""
        if self._folder is None:
            self._folder = Path(tempfile.mkdtemp(prefix="graphface-watch-"))
            if last is not None and self._evaluator.disk is None:
                self._leave(last, history)
        (self._folder / "files.json").write_text(json.dumps([str(path) for path in files]), encoding="utf-8")
        os.environ[_VARIABLE] = str(self._folder)
        sys.stdout.flush()
        sys.stderr.flush()
        os.execv(sys.executable, [sys.executable, *sys.orig_argv[1:]])

    def end(self) -> None:
        """Delete the folder, if there is one."""
        if self._folder is not None:
            shutil.rmtree(self._folder, ignore_errors=True)
            self._folder = None

    def _leave(self, last: Request, history: History) -> None:
        """Values go from memory to disk; all else that is needed is in them."""
        from graphface.cache.memory import MISSING
        from graphface.report.history import History

        assert self._folder is not None
        disk = _disk(self._folder)
        for step in last.steps():
            value, _ = self._evaluator.find(last.key(step.slot), step)
            if value is not MISSING:
                annotation = step.operator.output_annotation
                disk.put(last.key(step.slot), value, cost_seconds=1.0, meta={}, annotation=annotation)
        History.beside(self._folder / "cache").learn(last.graph.name, history.last(last.graph.name))

    def _take_over(self, request: Request, history: History) -> None:
        """Everything that still counts goes into memory, needed by this run or not; the folder is done with."""
        from graphface.report.history import History

        if self._folder is not None and (self._folder / "cache").is_dir():
            own, self._evaluator.disk = self._evaluator.disk, _disk(self._folder)
            for step in request.steps():
                self._evaluator.find(request.key(step.slot), step)
            self._evaluator.disk = own
            left = History.beside(self._folder / "cache").last(request.graph.name)
            history.learn(request.graph.name, left)
        self.end()


def _disk(folder: Path) -> DiskTier:
    """The values in the folder; what cannot be stored is computed again, which is no news."""
    from graphface.cache.disk import DiskTier
    from graphface.settings import cache_size

    return DiskTier(folder / "cache", cache_size(None), lambda _: None)
