"""Pinned nodes: a value that somebody gives stands in for a node, as if the node were a graph input.

The key of a pinned node is the digest of the value, like that of an input. So whatever is computed from it has keys of
its own, no cache can confuse it with what the node itself gives, and nothing above the node is needed.
"""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

from graphface.errors import InputError, UnreadableFile
from graphface.graph.inputs import Bound, bind
from graphface.graph.structure import GraphInput, Step
from graphface.graph.wired import WiredGraph
from graphface.values.port_types import ArrayType, PortType
from graphface.values.value_file import is_value_file, read_value


def bind_pinned(graph: WiredGraph, pinned: Mapping[str, Any]) -> dict[int, Bound]:
    """Pinned values by slot, with their digests.

    Args:
        pinned: node name to a value of the type that the node gives, or to a file of one: as its type is read, .npy
            for an array, .npz as `--dump` writes any value. What an earlier call made of one is taken as it is.

    Raises:
        InputError: there is no such node, or the value is not of its type. UnreadableFile: there is no such file.
    """
    steps = {name: graph.node(name) for name in pinned}
    given = {step.name: _read(pinned[name], step, graph) for name, step in steps.items()}
    ports = {step.name: _as_input(step) for step in steps.values()}
    bound = bind(ports, given, graph.registry.files, roots=[Path.cwd()])
    for one in bound.values():
        if not one.is_file:
            one.value  # noqa: B018 - checks it before anything runs
    return {ports[name].slot: one for name, one in bound.items()}


def _as_input(step: Step) -> GraphInput:
    return GraphInput(step.slot, step.name, step.operator.output, None, "", step.place)


def _read(value: Any, step: Step, graph: WiredGraph) -> Any:
    """The value in a file that no type reads by itself: one that was dumped, or an array; else what was given."""
    if not isinstance(value, str | Path):
        return value
    path, declared = Path(value), step.operator.output
    if path.suffix == ".npz" and is_value_file(path):
        return read_value(path, step.operator.output_annotation)
    files = graph.registry.files(declared)
    if files is not None and files.read is not None:
        return value
    if any(isinstance(a, ArrayType) or a is np.ndarray for a in declared.alternatives):
        return _read_array(path, declared)
    if any(isinstance(a, type) and issubclass(a, str | int | float | Path) for a in declared.alternatives):
        return value
    raise InputError(step.name, f"a {declared} is read from .npz, as --dump writes it; got {value!r}")


def _read_array(path: Path, declared: PortType) -> Any:
    if path.suffix != ".npy":
        raise InputError(str(path), f"a {declared} is read from .npy, or from .npz as --dump writes it")
    try:
        return np.load(path, allow_pickle=False)
    except (OSError, ValueError, EOFError) as error:
        raise UnreadableFile(path, getattr(error, "strerror", None) or str(error)) from None
