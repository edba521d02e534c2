"""What users hold: a graph that is loaded in one call and can run itself.

    graph = load("relight.yaml", profiles=["draft"], set={"mask.softness": 0.2})
    result = graph.run(photo="portrait.jpg", outputs=["image", "face/mesh.normals"])

Loading checks everything; what is left to fail in a run are the operators themselves.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cache
from pathlib import Path
from typing import Any

from graphface.cache.memory import MemoryTier
from graphface.document.compose import Choices, compose
from graphface.document.present_names import with_present_names
from graphface.document.source import read_source
from graphface.errors import UsageError
from graphface.evaluate import evaluator as evaluation
from graphface.evaluate.evaluator import Evaluator
from graphface.graph.request import Request, request
from graphface.graph.wired import WiredGraph
from graphface.registry import Registry, default_registry
from graphface.report import picture_size
from graphface.report.drawing.formats import write_drawing
from graphface.report.drawing.svg import draw_svg


def load(
    source: str | Path | Mapping[str, Any],
    *,
    variants: Sequence[str] = (),
    profiles: Sequence[str] = (),
    replace: Mapping[str, str] | None = None,
    set: Mapping[str, Any] | None = None,
    plugins: Sequence[str | Path] = (),
    registry: Registry | None = None,
) -> Graph:
    """A graph from a file, a shipped graph's name ("relight"), a YAML text, a mapping of the same form, or a result
    that carries its graph.

    Args:
        variants, profiles: names of overlays that the graph declares.
        replace: node path to the operator to use there instead.
        set: "node.parameter" to value; wins over everything.
        plugins: files of further operators.
        registry: where names are looked up; everything installed by default.

    Raises:
        DocumentError: the graph is wrong; all problems with file, line and column.
        UnreadableFile: there is no such file.
    """
    registry = registry if registry is not None else default_registry()
    if plugins:
        registry = registry.extended()
        for plugin in plugins:
            registry.add_file(Path(plugin))
    shipped = registry.graph_folders()
    choices = Choices(tuple(variants), tuple(profiles), dict(replace or {}), dict(set or {}))
    composition = compose(read_source(source, shipped, registry), choices, shipped=shipped)
    return Graph(with_present_names(composition, registry), registry)


@dataclass(eq=False)
class Result(evaluation.Result):
    """The outputs of a run by name; shows itself in a notebook, and as a report."""

    evaluator: Evaluator | None = field(default=None, repr=False)

    def report(self, path: str | Path, *, size: int = picture_size.DEFAULT) -> None:
        """Write the run as one HTML page with a picture of every value (see `graphface run --report`).

        Values are looked up by their keys where they are kept; of what is kept nowhere the page says so in words. When
        the nodes ran is not known afterwards, so the page has no timeline.

        Args:
            size: pixels of a picture's longer side.

        Raises:
            UnwritableFile: the folder is missing or cannot be written to.
        """
        from graphface.report.page.html import check_report, write_report
        from graphface.report.recorder import recorded

        if self.request is None or self.evaluator is None:
            raise UsageError("this result does not know its run")
        check_report(Path(path))
        write_report(recorded(self.request, self.records, self.outputs, self.evaluator.find, size), Path(path))

    def _repr_html_(self) -> str:
        from graphface.report.outputs import outputs_html

        return outputs_html(self.outputs, self.request) if self.request is not None else ""


class Graph(WiredGraph):
    """A wired graph that runs on an evaluator and shows itself in a notebook; see `load`."""

    def run(
        self, /, outputs: Iterable[str] | None = None, *, evaluator: Evaluator | None = None, **inputs: Any
    ) -> Result:
        """Evaluate outputs and only what they need.

        Args:
            outputs: names of declared outputs, or any "node" or "node.field"; all declared ones by default.
            evaluator: where to run and what to keep; by default one per process, with a memory tier of the size
                that the user has set (`graphface.settings`).
            inputs: arrays, values or paths by input name; none can be called `outputs` or `evaluator`.

        Raises:
            InputError, UnreadableFile: an input is missing or does not fit. RunFailed: a node failed.
        """
        evaluator = evaluator if evaluator is not None else shared_evaluator()
        asked = request(self, inputs, outputs)
        done = evaluator.run(asked)
        return Result(done.outputs, done.records, asked, evaluator)

    def request(
        self,
        inputs: Mapping[str, Any] | None = None,
        outputs: Iterable[str] | None = None,
        *,
        pinned: Mapping[str, Any] | None = None,
    ) -> Request:
        """What an evaluator runs, and what can be planned and explained; see `graphface.graph.request`."""
        return request(self, inputs or {}, outputs, pinned)

    def draw(self, path: str | Path) -> None:
        """Draw the graph into a file: .html (zooms and folds), .svg, .png, .mmd (Mermaid) or .dot (Graphviz).

        Raises:
            RefusedOutput: no drawing has this suffix, or the folder is missing or read-only.
        """
        write_drawing(self, Path(path))

    def _repr_html_(self) -> str:
        return f'<div style="overflow: auto; max-height: 85vh">{draw_svg(self)}</div>'


@cache
def shared_evaluator() -> Evaluator:
    """The evaluator of every `Graph.run` that is not given one."""
    return Evaluator(memory=MemoryTier())
