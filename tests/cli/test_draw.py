"""`graphface draw`: a graph as a picture, a page or a text."""

from collections.abc import Callable
from pathlib import Path

import pytest


class TestDraw:
    @pytest.mark.parametrize(
        ("name", "begins"), [("g.svg", b"<svg"), ("g.html", b"<!DOCTYPE"), ("g.png", b"\x89PNG"), ("g.gv", b"digraph")]
    )
    def test_file(
        self, graphface: Callable[..., object], graph: Path, plugin: list[str], tmp_path: Path, name: str, begins: bytes
    ) -> None:
        """The suffix says which format."""
        assert graphface("draw", graph, *plugin, "-o", tmp_path / name).code == 0
        assert (tmp_path / name).read_bytes().startswith(begins)

    def test_standard_output(self, graphface: Callable[..., object], graph: Path, plugin: list[str]) -> None:
        """Mermaid, or the format that is named."""
        assert graphface("draw", graph, *plugin).out.startswith("flowchart LR\n")
        assert graphface("draw", graph, *plugin, "--format", "dot").out.startswith("digraph")

    def test_plan(self, graphface: Callable[..., object], graph: Path, plugin: list[str]) -> None:
        """With inputs or outputs the drawing says what would run and what would not."""
        plain = graphface("draw", graph, *plugin, "--format", "svg").out
        planned = graphface("draw", graph, *plugin, "--format", "svg", "-i", "x=1").out
        assert "would run" not in plain
        assert "would run" in planned
        assert "not needed for scaled" in planned
        other = graphface("draw", graph, *plugin, "--format", "svg", "--output", "unused").out
        assert "not needed for unused" in other

    def test_cache(self, graphface: Callable[..., object], graph: Path, plugin: list[str], tmp_path: Path) -> None:
        """What a cache holds is marked."""
        cache = ["--cache", tmp_path / "cache"]
        assert graphface("run", graph, *plugin, *cache, "-o", f"scaled={tmp_path / 's.npy'}").code == 0
        assert "node hue-" in (drawn := graphface("draw", graph, *plugin, *cache, "-i", "x=2", "--format", "svg").out)
        assert " disk" in drawn

    @pytest.mark.parametrize(
        ("flags", "said"),
        [
            (["-o", "g.jpg"], "no drawing is written as '.jpg'"),
            (["--format", "pgn"], "did you mean 'png'"),
            (["--format", "png"], "name one with -o"),
        ],
    )
    def test_refused(
        self, graphface: Callable[..., object], graph: Path, plugin: list[str], flags: list[str], said: str
    ) -> None:
        """Formats that are not there, and a PNG in a terminal."""
        answer = graphface("draw", graph, *plugin, *flags)
        assert answer.code == 2
        assert said in answer.err
