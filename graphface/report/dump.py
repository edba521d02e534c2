"""Values of a run in a folder, to be looked at and compared: `run --dump`, `diff --golden`.

A value is one .npz that loses nothing (`graphface.values.value_file`).

    face/mesh.npz    the value of node face/mesh
    face/mesh.png    its picture
    run.json         what happened at every node (`graphface.report.trace`)
"""

from __future__ import annotations

import json
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from graphface.errors import UnwritableFile, UsageError
from graphface.evaluate.evaluator import Evaluator
from graphface.fallback import python_warnings, warn
from graphface.graph.request import Request
from graphface.graph.structure import Ref, Step
from graphface.pictures import draw
from graphface.record import Record
from graphface.report.drawn import write_pixels
from graphface.report.trace import Trace
from graphface.report.watching import Watcher
from graphface.values.codec import CodecError
from graphface.values.picture import View
from graphface.values.value_file import write_value
from graphface.values.writing import check_folder, make_folder

RUN = "run.json"


class Dump(Watcher):
    """Writes every value of a run into a folder as soon as it is there, and `run.json` at the end.

    Nothing is kept in memory. A value that cannot be stored has its picture only, and a warning says so.
    """

    def __init__(self, folder: Path, evaluator: Evaluator) -> None:
        super().__init__(evaluator, every=True)
        self._folder = folder
        self._trace = Trace()
        self._failure: UnwritableFile | None = None

    def check(self) -> None:
        """Make the folder, and take away what an earlier dump left in it, so that only one run's values are there.

        Raises:
            UsageError: it holds files that no dump wrote. RefusedOutput: it cannot be written to.
        """
        make_folder(self._folder)
        check_folder(self._folder / RUN)
        for name in _dumped_before(self._folder):
            for suffix in (".npz", ".png"):
                value_path(self._folder, name, suffix).unlink(missing_ok=True)

    def write(self) -> None:
        """Write `run.json`.

        Raises:
            UnwritableFile: some file of the dump could not be written.
        """
        if self._failure is not None:
            raise self._failure
        if self.request is not None:
            self._trace.write_to(self._folder / RUN)

    def run_started(self, request: Request) -> None:
        super().run_started(request)
        self._trace.run_started(request)

    def node_started(self, name: str, step: Step | None) -> None:
        self._trace.node_started(name, step)

    def node_finished(self, record: Record, step: Step | None, value: Any) -> None:
        self._trace.node_finished(record, step, value)
        super().node_finished(record, step, value)

    def run_finished(self, records: Sequence[Record]) -> None:
        super().run_finished(records)
        self._trace.run_finished(records)

    def on_value(self, slot: int, value: Any) -> None:
        assert self.request is not None
        if self._failure is not None:
            return
        graph = self.request.graph
        name = graph.names[slot]
        try:
            value_path(self._folder, name).parent.mkdir(parents=True, exist_ok=True)
            picture = draw(value, graph.type_of(Ref(slot)), graph.registry, View(above=self.above(slot)))
            write_pixels(picture.pixels, value_path(self._folder, name, ".png"))
            self._store(name, value)
        except OSError as error:
            self._failure = UnwritableFile(self._folder / name, error.strerror or str(error))
        except UnwritableFile as error:
            self._failure = error

    def _store(self, name: str, value: Any) -> None:
        try:
            write_value(value, value_path(self._folder, name))
        except UnwritableFile as error:
            if not isinstance(error.__context__, CodecError):
                raise
            with python_warnings():  # it is no node's fault
                warn(f"--dump: {name} has its picture only: {error.__context__}")


def value_path(folder: Path, name: str, suffix: str = ".npz") -> Path:
    """The file of a node or an input in a dump; nested graphs are folders."""
    return folder.joinpath(*name.split("/")[:-1], name.rpartition("/")[2] + suffix)


def _dumped_before(folder: Path) -> list[str]:
    """The names of what an earlier dump left in a folder.

    Raises:
        UsageError: other files are in it.
    """
    if not any(folder.iterdir()):
        return []
    try:
        trace = json.loads((folder / RUN).read_text(encoding="utf-8"))
        return [str(entry["name"]) for entry in trace["nodes"]]
    except (OSError, ValueError, KeyError, TypeError):
        reason = f"{folder}: holds files that no --dump wrote; name a new folder, or an empty one"
        raise UsageError(reason) from None
