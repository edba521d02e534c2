"""`graphface show`: the effective document, with where each value comes from."""

from collections.abc import Callable
from pathlib import Path

from graphface import load


class TestShow:
    def test_origins(self, graphface: Callable[..., object], graph: Path, plugin: list[str]) -> None:
        """Behind a value stands the line, or the flag, that set it."""
        said = graphface("show", graph, *plugin, "--set", "s.by=7")
        assert said.code == 0
        (line,) = (line for line in said.out.splitlines() if "by: 7" in line)
        assert "--set" in line
        assert f"{graph.name}:5" in said.out

    def test_runs_as_it_is(self, graphface: Callable[..., object], graph: Path, plugin: list[str]) -> None:
        """The text is a graph that gives the same; `--no-origins` leaves the comments out."""
        said = graphface("show", graph, *plugin, "--no-origins", "--profile", "draft")
        assert "#" not in said.out
        grid = load(said.out, plugins=plugin[1:]).run(["g"])["g"]
        assert grid.shape == (2, 2)
