"""A failed node in a file: what it was given, its parameters and which code it was, to run it again elsewhere.

The file is a zip of `failure.json` and of one .npy for each array, `inputs/0.npy` and so on. Values are taken apart as
for the disk tier (`graphface.values.codec`); no pickle. `graphface.report.replay` reads it.
"""

from __future__ import annotations

import json
import platform
import sys
import zipfile
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from graphface.errors import UnwritableFile
from graphface.evaluate.observe import Observer
from graphface.fingerprint import fingerprint
from graphface.graph.request import Request
from graphface.graph.structure import Step
from graphface.record import Record
from graphface.report.trace import versions
from graphface.values.codec import CodecError, Tensors, encode
from graphface.values.writing import beside

FORMAT = "graphface-failure/1"
MANIFEST = "failure.json"


@dataclass(eq=False)
class Failed:
    """A node that failed in a run.

    Attributes:
        arguments: by port; None where it failed before it was called, in its `needs` rule.
        reason: what it said. others: the names of nodes that failed in the same run.
    """

    request: Request
    step: Step
    arguments: Mapping[str, Any] | None
    reason: str
    others: Sequence[str] = ()


class FirstFailure(Observer):
    """Keeps the first node that fails in a run, as `failed`."""

    def __init__(self) -> None:
        self.failed: Failed | None = None
        self._request: Request | None = None
        self._called: dict[str, Mapping[str, Any]] = {}

    def run_started(self, request: Request) -> None:
        self._request, self.failed = request, None
        self._called.clear()

    def node_called(self, name: str, step: Step, arguments: Mapping[str, Any]) -> None:
        self._called[name] = arguments

    def node_finished(self, record: Record, step: Step | None, value: Any) -> None:
        arguments = self._called.pop(record.name, None)
        if record.state != "failed" or step is None or self._request is None:
            return
        if self.failed is None:
            self.failed = Failed(self._request, step, arguments, record.reason)
        else:
            self.failed.others = [*self.failed.others, record.name]


def write_failure(failed: Failed, path: Path) -> None:
    """Write a failed node, whole or not at all.

    Raises:
        UnwritableFile: the folder cannot be written to, or a value is of no kind that can be stored.
    """
    if failed.arguments is None:
        raise UnwritableFile(path, f"node {failed.step.name!r} failed in its needs rule, before it was given anything")
    inputs, given = _encoded(failed.arguments, path)
    parameters, settings = _encoded(failed.step.parameters, path)
    manifest = {**_about(failed), "inputs": given, "parameters": settings}
    with beside(path) as unfinished, zipfile.ZipFile(unfinished, "w", zipfile.ZIP_DEFLATED, compresslevel=1) as archive:
        archive.writestr(MANIFEST, json.dumps(manifest, indent=1))
        for folder, tensors in (("inputs", inputs), ("parameters", parameters)):
            for name, array in tensors.items():
                with archive.open(f"{folder}/{name}.npy", "w", force_zip64=True) as member:
                    np.lib.format.write_array(member, array, allow_pickle=False)


def _encoded(values: Mapping[str, Any], path: Path) -> tuple[Tensors, dict[str, Any]]:
    try:
        tensors, structure = encode(dict(values))
    except CodecError as error:
        raise UnwritableFile(path, str(error)) from None
    return tensors, dict(structure["dict"])


def _about(failed: Failed) -> dict[str, Any]:
    step = failed.step
    code = fingerprint(step.operator.function, step.operator.needs)
    return {
        "format": FORMAT,
        "graph": failed.request.graph.name,
        "node": step.name,
        "place": str(step.place),
        "operator": step.operator.name,
        "version": step.operator.version,
        "code": code.digest.hex(),
        "reached": list(code.reached),
        "error": failed.reason,
        "others": list(failed.others),
        "versions": versions(),
        "platform": f"{sys.platform} {platform.machine()}",
    }
