"""What the page says of each node."""

import contextlib
import json
from typing import Any

import pytest
from toys import toy_registry

from graphface import Evaluator, RunFailed, load
from graphface.report.page.model import model
from graphface.report.recorder import Recorder

TEXT = """\
graphface: 1
name: modeled
inputs: {x: {type: float, default: 2}}
nodes:
  grid: {use: toy.grid, with: {size: 8}}
  pair: {use: toy.pair, in: {grid: grid}}
  low: {use: toy.scale, in: {grid: pair.low}}
  warned: {use: toy.fall_back, in: {a: x}}
  gate: {use: toy.gate, in: {a: x, extra: warned}, with: {open: false}}
  bad: {use: toy.fail, in: {a: warned}}
  below: {use: toy.add, in: {a: bad, b: gate}}
  cut: {use: toy.interrupt, in: {a: warned}}
"""


def modeled(*outputs: str) -> dict[str, Any]:
    """The model of a run, failed or not; through JSON, as the page gets it."""
    graph = load(TEXT, registry=toy_registry(), set={"low.by": 3.0})
    evaluator = Evaluator(guard="off")
    recorder = Recorder(evaluator.find, 16)
    with contextlib.suppress(KeyboardInterrupt):
        try:
            evaluator.run(graph.request({}, outputs), [recorder])
        except RunFailed as error:
            recorder.stopped(error)
    said: dict[str, Any] = json.loads(json.dumps(model(recorder), allow_nan=False))
    said["by_name"] = {node["name"]: node for node in said["nodes"]}
    return said


def test_top() -> None:
    """Name, outputs, counts by state, and the effective graph."""
    said = modeled("low")
    assert (said["graph"], said["outputs"]) == ("modeled", [{"name": "low", "node": "low", "field": ""}])
    assert said["counts"] == {"ran": 3, "skipped": 6}
    assert said["first"] == "low"
    assert said["stopped"] == ""
    assert "toy.scale" in said["yaml"]


def test_parameters() -> None:
    """A parameter has its value and who set it; others are defaults."""
    nodes = modeled("low")["by_name"]
    by = {one["name"]: one for one in nodes["low"]["parameters"]}["by"]
    assert (by["value"], by["set"], by["place"]) == ("3.0", True, "--set")
    size, fill, label = nodes["grid"]["parameters"]
    assert size["set"]
    assert size["place"].startswith("<text>:5:")
    assert (fill["value"], fill["set"]) == ("1.0", False)
    assert not label["set"]


def test_wires() -> None:
    """A port has the node and field that are plugged in, or why they were declined."""
    nodes = modeled("gate", "low")["by_name"]
    assert nodes["low"]["ports"][0]["wires"] == [{"node": "pair", "field": "low"}]
    extra = {port["port"]: port for port in nodes["gate"]["ports"]}["extra"]
    assert extra["declined"] == "the gate is shut"
    assert nodes["warned"]["reason"] == "gate declined it: the gate is shut"


def test_failed() -> None:
    """The page opens on the node that failed; those below say by whom they are blocked."""
    said = modeled("below")
    bad = said["by_name"]["bad"]
    assert said["first"] == "bad"
    assert bad["state"] == "failed"
    assert bad["error"]["reason"] == "ValueError: it broke"
    assert "raise ValueError" in bad["error"]["code"]
    assert said["by_name"]["below"]["reason"] == "blocked by bad"
    assert said["by_name"]["warned"]["warnings"] == ["2 was too much"]


def test_interrupted() -> None:
    """The page opens on the node that was at work."""
    said = modeled("cut")
    assert (said["first"], said["stopped"]) == ("cut", "interrupted")
    assert said["by_name"]["cut"]["state"] == "stopped"


def test_no_run() -> None:
    """Without a run there is nothing to show."""
    with pytest.raises(RuntimeError, match="no run"):
        model(Recorder(Evaluator().find))
