"""What `-o NAME=FILE` writes: values as their types are written, or as their pictures."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from graphface.errors import GraphfaceError, RunError
from graphface.evaluate.evaluator import Evaluator
from graphface.evaluate.observe import Observer
from graphface.graph.structure import Ref
from graphface.graph.wired import WiredGraph
from graphface.report.drawn import DrawnOutputs, write_pixels
from graphface.values.writing import check_folder, check_output, is_drawn, may_be_drawn, write_output


class OutputFiles:
    """The files of a graph's outputs, of one run or of many.

    Args:
        targets: name to what is asked for.
    """

    def __init__(self, graph: WiredGraph, targets: Mapping[str, Ref], evaluator: Evaluator) -> None:
        self._graph = graph
        self._types = {name: graph.type_of(target) for name, target in targets.items()}
        self._drawn = DrawnOutputs(graph, targets, evaluator)

    def check(self, files: Mapping[str, Path]) -> None:
        """See before anything runs that they can be written.

        Raises:
            UsageError: one cannot.
        """
        for name, path in files.items():
            check_output(path, self._types[name], self._graph.registry.files)

    def observers(self, files: Mapping[str, Path]) -> list[Observer]:
        """Who has to see the run, so that pictures can be drawn over what their values were made from."""
        files_of = self._graph.registry.files
        self._drawn.wanted = {name for name, path in files.items() if may_be_drawn(path, self._types[name], files_of)}
        return [self._drawn] if self._drawn.wanted else []

    def write(self, values: Mapping[str, Any], files: Mapping[str, Path]) -> None:
        """Write the values of a run; where one cannot be written, the others are all the same.

        Raises:
            GraphfaceError: some could not be written, each with its reason.
        """
        files_of, text = self._graph.registry.files, self._graph.provenance()
        failed: list[GraphfaceError] = []
        for name, path in files.items():
            try:
                check_folder(path)
                if is_drawn(values[name], self._types[name], path, files_of):
                    write_pixels(self._drawn.picture(name, values[name]).pixels, path)
                else:
                    write_output(values[name], self._types[name], path, files_of, text=text)
            except GraphfaceError as error:
                failed.append(error)
        if len(failed) == 1:
            raise failed[0]
        if failed:
            raise RunError("\n".join(str(error) for error in failed))
