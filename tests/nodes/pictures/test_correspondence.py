"""Displacements and the warped checkerboard."""

from __future__ import annotations

import numpy as np

from graphface.nodes.pictures.correspondence import draw_correspondence, flow_colors
from graphface.nodes.types import Correspondence
from graphface.values.picture import View


def shifted(by: float, valid: float = 1.0) -> Correspondence:
    x, y = np.meshgrid(np.arange(60.0), np.arange(40.0))
    places = np.stack([x + by, y], axis=2).astype(np.float32)
    share = np.full((40, 60), valid, np.float32)
    return Correspondence(places, np.ones((40, 60), np.float32), share, (40, 60))


def test_flow_colors():
    """No motion is white; to the right is red, to the left cyan; stronger motion is a stronger color."""
    flow = np.float32([[[0, 0], [1, 0], [-1, 0], [0.5, 0]]])
    assert flow_colors(flow)[0].tolist() == [[255, 255, 255], [255, 0, 0], [0, 255, 255], [255, 128, 128]]


def test_common_shift():
    """What all points have in common is told in the note, and colors show what is left."""
    picture = draw_correspondence(shifted(7), View())
    assert "from the median (7, 0) px" in picture.note
    assert "100% of the picture corresponds" in picture.note
    assert (picture.pixels[:20, :60] == 255).all(axis=2).mean() > 0.5


def test_data():
    """The position in the reference, under both halves."""
    made = shifted(3)
    picture = draw_correspondence(made, View())
    np.testing.assert_array_equal(picture.data[:, :60, :2], made.places)
    np.testing.assert_array_equal(picture.data[:, 60:, :2], made.places)


def test_unknown():
    """Where nothing corresponds the backdrop is left, in both halves."""
    picture = draw_correspondence(shifted(3, valid=0.0), View())
    assert (picture.pixels == 64).all(axis=2).mean() > 0.75
    assert "0% of the picture corresponds" in picture.note
