"""What the page of a run shows, as JSON: plain texts and numbers, no markup."""

from __future__ import annotations

import math
import time
from collections import Counter
from collections.abc import Iterable
from typing import Any

from graphface.document.effective import origin
from graphface.errors import NodeError
from graphface.evaluate.reason import Reason
from graphface.graph.structure import Argument, Ref, Step
from graphface.place import Place
from graphface.report.array_figures import Figures
from graphface.report.blobs import Sheet
from graphface.report.recorder import Recorder, Seen
from graphface.values.parts import SCALARS

Json = dict[str, Any]


def model(recorder: Recorder) -> Json:
    """Everything on the page but the drawing and the blobs.

    Raises:
        RuntimeError: no run was followed.
    """
    request = recorder.request
    if request is None:
        raise RuntimeError("this report followed no run")
    graph = request.graph
    nodes = [_node(recorder, entry) for entry in recorder.seen]
    outputs = [
        {"name": name, "node": graph.names[ref.slot], "field": ".".join(ref.fields)}
        for name, ref in request.targets.items()
    ]
    return {
        "graph": graph.name,
        "doc": graph.composition.doc,
        "made": time.strftime("%Y-%m-%d %H:%M:%S"),
        "outputs": outputs,
        "seconds": recorder.seconds,
        "drawing": recorder.drawing,
        "counts": dict(Counter(node["state"] for node in nodes)),
        "stopped": _stopped(recorder),
        "first": _first(nodes, outputs),
        "nodes": nodes,
        "inputs": _inputs(recorder),
        "yaml": graph.effective(),
    }


def _node(recorder: Recorder, entry: Seen) -> Json:
    assert recorder.request is not None
    graph = recorder.request.graph
    step, name, record = graph.step(entry.slot), graph.names[entry.slot], entry.record
    state = _state(recorder, entry, name)
    shown: Json = {
        "name": name,
        "state": state,
        "reason": _reason(recorder, entry, state),
        "start": entry.start,
        "thread": entry.thread,
        "value": recorder.trace.summaries.get(name, ""),
        "sheets": [_sheet(sheet) for sheet in entry.sheets],
        "arrays": [_figures(path, found) for path, found in entry.arrays],
        "key": recorder.request.key(entry.slot).hex(),
    }
    if record is not None:
        shown |= {"seconds": record.seconds, "cpu": record.cpu, "bytes": record.bytes}
        shown["warnings"] = list(record.warnings)
    if name in recorder.errors:
        shown["error"] = _error(recorder.errors[name])
    return shown | (_of_step(recorder, step) if step is not None else _of_input(recorder, entry.slot))


def _state(recorder: Recorder, entry: Seen, name: str) -> str:
    """As its record says; of others, whether they had begun when the run was stopped."""
    if entry.record is not None:
        return entry.record.state
    return "stopped" if recorder.began(name) else "skipped"


def _reason(recorder: Recorder, entry: Seen, state: str) -> str:
    assert recorder.request is not None
    graph = recorder.request.graph
    if state == "blocked":
        behind = {graph.names[slot] for slot in graph.behind([Ref(entry.slot)])}
        failed = [r.name for r in recorder.trace.records if r.state == "failed" and r.name in behind]
        return f"blocked by {', '.join(failed)}" if failed else entry.reason
    if state == "stopped":
        return "the run ended here"
    if recorder.stopped_by is not None and entry.reason == str(Reason("not reached")):
        return "the run ended before it was needed"
    return entry.reason


def _of_step(recorder: Recorder, step: Step) -> Json:
    assert recorder.request is not None
    operator = step.operator
    declined = {
        record.name.rpartition(".")[2]: record.reason
        for record in recorder.trace.records
        if record.state == "declined" and record.name.rpartition(".")[0] == step.name
    }
    plugged = {argument.port: argument for argument in step.arguments}
    ports = [
        _port(recorder, name, str(port.type), plugged.get(name), declined.get(name, ""))
        for name, port in operator.inputs.items()
    ]
    parameters = []
    for name, value in step.parameters.items():
        setting = step.settings.get(name)
        place = setting.place if setting is not None else None
        parameters.append(
            {"name": name, "value": _text(value), "set": setting is not None, "place": _place(place) or "set in Python"}
        )
    return {
        "operator": operator.name,
        "type": str(operator.output),
        "doc": operator.doc,
        "place": _place(step.place),
        "ports": ports,
        "parameters": parameters,
    }


def _of_input(recorder: Recorder, slot: int) -> Json:
    assert recorder.request is not None
    graph = recorder.request.graph
    entry = graph.inputs[graph.names[slot]]
    bound = recorder.request.bound[slot]
    origin_of = bound.origin if bound is not None else "not given"
    return {
        "operator": "",
        "type": str(entry.type),
        "doc": entry.doc,
        "place": _place(entry.place),
        "origin": origin_of,
        "ports": [],
        "parameters": [],
    }


def _port(recorder: Recorder, name: str, declared: str, argument: Argument | None, declined: str) -> Json:
    assert recorder.request is not None
    names = recorder.request.graph.names
    refs = argument.refs if argument is not None else ()
    wires = [{"node": names[ref.slot], "field": ".".join(ref.fields)} for ref in refs]
    return {"port": name, "type": declared, "wires": wires, "declined": declined}


def _sheet(sheet: Sheet) -> Json:
    shown: Json = {
        "label": sheet.label,
        "type": sheet.type,
        "note": sheet.note,
        "width": sheet.width,
        "height": sheet.height,
        "image": sheet.image,
    }
    packed = sheet.packed
    if packed is not None:
        shown["data"] = {
            "planes": sheet.planes,
            "height": packed.height,
            "width": packed.width,
            "channels": packed.channels,
            "bits": packed.bits,
            "low": packed.low,
            "step": packed.step,
            "special": packed.special,
            "exact": packed.exact,
            "whole": packed.whole,
            "names": sheet.channels,
            "full": sheet.full,
        }
    return shown


def _figures(path: str, found: Figures) -> Json:
    return {
        "path": path,
        "dtype": found.dtype,
        "shape": found.shape,
        "low": _finite(found.low),
        "high": _finite(found.high),
        "mean": _finite(found.mean),
        "nan": found.nan,
        "infinite": found.infinite,
        "counts": found.counts,
    }


def _error(error: NodeError) -> Json:
    return {
        "reason": error.reason,
        "place": _place(error.place),
        "code": str(error.code) if error.code is not None else "",
        "inputs": error.inputs,
        "files": error.files,
    }


def _stopped(recorder: Recorder) -> str:
    """Why the run ended before it was done, where no node failed."""
    error = recorder.stopped_by
    if error is None:
        return ""
    if isinstance(error, KeyboardInterrupt):
        return "interrupted"
    return str(error) or type(error).__name__


def _first(nodes: Iterable[Json], outputs: list[Json]) -> str:
    """The node that the page opens on: the first that failed, or was at work when the run was stopped; an output."""
    for wanted in ("failed", "stopped"):
        found = [node for node in nodes if node["state"] == wanted]
        if found:
            return str(min(found, key=lambda node: node["start"] or 0)["name"])
    return str(outputs[0]["node"]) if outputs else ""


def _inputs(recorder: Recorder) -> list[Json]:
    assert recorder.request is not None
    bound = recorder.request.bound
    entries = recorder.request.graph.inputs.values()
    return [
        {
            "name": entry.name,
            "type": str(entry.type),
            "origin": one.origin if one is not None else "not given",
            "digest": one.digest.hex() if one is not None else "",
        }
        for entry, one in zip(entries, bound, strict=True)
    ]


def _text(value: Any) -> str:
    text = repr(value) if type(value) in SCALARS else str(value)
    return text if len(text) <= 2000 else text[:2000] + "..."


def _place(place: Place | None) -> str:
    return origin(place) if place is not None else ""


def _finite(number: float) -> float | str:
    return number if math.isfinite(number) else str(number)
