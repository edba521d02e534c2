"""The files of a run's outputs: one that cannot be written costs no other."""

from pathlib import Path

import pytest

from graphface import Evaluator, Registry, load
from graphface.cli.run_once import run_once
from graphface.errors import RunError


def test_the_others_are_written(registry: Registry, tmp_path: Path) -> None:
    """Where one cannot be written when it is there, those after it are."""
    number = "nodes: {n: {use: toy.number}, m: {use: toy.number}, a: {use: toy.grid}}\n"
    graph = load(f"graphface: 1\n{number}outputs: {{y: a}}\n", registry=registry)
    output = [f"{name}={tmp_path / name}.npz" for name in "nma"]
    with pytest.raises(RunError, match=r"n\.npz.*\n.*m\.npz"):
        run_once(graph, output, {}, Evaluator(), [], history=None)
    assert (tmp_path / "a.npz").is_file()
