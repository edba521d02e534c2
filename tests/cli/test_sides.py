"""What `graphface diff` compares, from words on the command line."""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest
from toys import __file__ as toys

from graphface import InputError, UsageError
from graphface.cli.sides import Flags, Given, bound_inputs, read_sides

COMMON = Flags(plugins=[Path(toys)])


def read_side(text: str, common: Flags) -> Given:
    return read_sides([text], common)[0]


def test_flags_of_one_side(graph: Path) -> None:
    """As those of run, in one word."""
    side = read_side(f"{graph} --set s.by=5 --replace unused=toy.subtract --profile draft -i x=4", COMMON)
    steps = {step.name: step for step in side.graph.steps}
    assert (steps["s"].parameters["by"], steps["g"].parameters["size"]) == (5, 2)
    assert (steps["unused"].operator.name, side.inputs) == ("toy.subtract", {"x": "4"})


def test_own_flags_win(graph: Path) -> None:
    """Over those for both."""
    side = read_side(f"{graph} --set s.by=5", Flags(sets=["s.by=1"], plugins=COMMON.plugins))
    assert {step.name: step for step in side.graph.steps}["s"].parameters["by"] == 5


def test_a_name_with_spaces(graph: Path, tmp_path: Path) -> None:
    """A word that names a file is one."""
    path = tmp_path / "my graph --set.yaml"
    shutil.copy(graph, path)
    assert read_side(str(path), COMMON).graph.name == "toys"


def test_plugins_are_loaded_once(graph: Path) -> None:
    """Equal nodes of both sides have equal keys, whether the plug-in stands in the quotes or outside."""
    for texts, common in (([str(graph)] * 2, COMMON), ([f"{graph} --plugin {toys}"] * 2, Flags())):
        requests = [side.graph.request() for side in read_sides(texts, common)]
        assert requests[0].keys.by_slot == requests[1].keys.by_slot


def test_bound_inputs(graph: Path) -> None:
    """A side's own, then those for both, then what the other side has."""
    own, none = read_side(f"{graph} -i x=4", COMMON), read_side(str(graph), COMMON)
    assert bound_inputs([own, none], []) == [{"x": "4"}, {"x": "4"}]
    assert bound_inputs([own, none], ["x=7"]) == [{"x": "4"}, {"x": "7"}]


def test_mistakes(graph: Path) -> None:
    """An input that no side has, a flag that is none."""
    with pytest.raises(InputError, match="no side has such an input"):
        bound_inputs([read_side(str(graph), COMMON)], ["z=1"])
    with pytest.raises(UsageError, match="expected GRAPH with any of -i"):
        read_side(f"{graph} extra", COMMON)
