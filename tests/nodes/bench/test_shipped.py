"""What is at hand without any data."""

from __future__ import annotations

from pathlib import Path

from graphface.nodes.bench.shipped import astronaut, shipped_scenes


class TestShippedScenes:
    def test_all_of_them_by_name(self):
        """Every scene file beside the graphs, sorted: the default of the command."""
        folder = Path(__file__).resolve().parents[3] / "graphs/scenes"
        found = shipped_scenes()
        assert [p.name for p in found] == sorted(p.name for p in folder.glob("*.yaml"))
        assert len(found) > 10


class TestAstronaut:
    def test_form(self):
        """A photograph of 8 bits."""
        photo = astronaut()
        assert photo.shape == (512, 512, 3)
        assert photo.dtype.name == "uint8"
