"""Outputs as pictures: over what they were made from, written whole."""

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from PIL import Image
from toys import Grid, toy_registry

from graphface import Evaluator, UnwritableFile, load
from graphface.report.drawn import DrawnOutputs, write_pixels
from graphface.values.picture import Picture, View

TEXT = """\
graphface: 1
nodes:
  grid: {use: toy.grid, with: {size: 4, fill: 3}}
  pair: {use: toy.pair, in: {grid: grid}}
"""


def test_field_with_what_is_above() -> None:
    """A field of a node is drawn as its own type, with what its node was made from above it."""
    registry = toy_registry()

    def see(value: Any, view: View) -> Picture:
        above = view.above(np.ndarray)
        return Picture(np.full((1, 1, 3), 10 * value[0, 0] + (0 if above is None else above[0, 0]), np.uint8))

    registry.add_picture(Grid, see)
    graph, evaluator = load(TEXT, registry=registry), Evaluator()
    targets = graph.targets(["pair.high", "grid"])
    drawn = DrawnOutputs(graph, targets, evaluator)
    result = evaluator.run(graph.request({}, targets), [drawn])
    assert drawn.picture("pair.high", result["pair.high"]).pixels[0, 0, 0] == 63
    assert drawn.picture("grid", result["grid"]).pixels[0, 0, 0] == 30


def test_alone() -> None:
    """A value that no run told is drawn by itself."""
    graph = load(TEXT, registry=toy_registry())
    drawn = DrawnOutputs(graph, graph.targets(["grid"]), Evaluator())
    assert drawn.picture("grid", np.eye(5)).pixels.shape == (5, 5, 3)


class TestWritePixels:
    @pytest.mark.parametrize(("suffix", "tolerance"), [(".png", 0), (".webp", 0), (".jpg", 12), (".JPEG", 12)])
    def test_formats(self, tmp_path: Path, suffix: str, tolerance: int) -> None:
        """PNG and WebP without loss; a JPEG nearly so."""
        ramp = np.repeat(np.arange(0, 240, 4, dtype=np.uint8)[None, :, None], 3, axis=2).repeat(20, axis=0)
        write_pixels(ramp, tmp_path / f"a{suffix}")
        with Image.open(tmp_path / f"a{suffix}") as opened:
            assert np.abs(np.asarray(opened.convert("RGB")).astype(int) - ramp).max() <= tolerance

    def test_refused(self, tmp_path: Path) -> None:
        """A folder that cannot be made, and a picture that the format cannot hold; no file is left."""
        with pytest.raises(UnwritableFile):
            write_pixels(np.zeros((2, 2, 3), np.uint8), tmp_path / ("x" * 300) / "a.png")
        with pytest.raises(UnwritableFile):
            write_pixels(np.zeros((1, 20_000, 3), np.uint8), tmp_path / "a.webp")
        assert not list(tmp_path.iterdir())
