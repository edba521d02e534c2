"""The detector: boxes of faces, merged, in the picture's own pixels."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from graphface.nodes.landmarks.blazeface import _MODELS, Face, _anchors, _letterbox, _merge, detect


class TestAnchors:
    @pytest.mark.parametrize(("model", "count"), [("near", 896), ("far", 2304)])
    def test_one_for_each_detection(self, model, count):
        """One anchor for each row of the network's output."""
        assert _anchors(_MODELS[model].grids).shape == (count, 2)

    def test_cell_centers(self):
        """The first cell of a 16 x 16 grid has its center at 1/32, twice; cells follow row by row."""
        anchors = _anchors(_MODELS["near"].grids)
        np.testing.assert_allclose(anchors[:3], [[1 / 32, 1 / 32], [1 / 32, 1 / 32], [3 / 32, 1 / 32]])
        np.testing.assert_allclose(anchors[512], [1 / 16, 1 / 16])


class TestLetterbox:
    @given(st.integers(1, 900), st.integers(1, 900))
    def test_corners(self, width, height):
        """The picture's outer corners in the square map to its corners."""
        square, matrix = _letterbox(np.ones((height, width, 3), np.float32), 256)
        rows, columns = np.flatnonzero(square.any(axis=(1, 2))), np.flatnonzero(square.any(axis=(0, 2)))
        corners = np.array([[columns[0], rows[0]], [columns[-1] + 1, rows[-1] + 1]], np.float32)
        back = corners @ matrix[:, :2].T + matrix[:, 2]
        np.testing.assert_allclose(back, [[-0.5, -0.5], [width - 0.5, height - 0.5]], atol=1e-2 * max(width, height))


class TestMerge:
    def test_overlapping_detections(self):
        """Two boxes of one face give their mean, weighted by the scores."""
        boxes = np.array([[0, 0, 10, 10], [2, 0, 12, 10], [50, 50, 60, 60]], np.float32)
        faces = _merge(boxes, np.zeros((3, 6, 2), np.float32), np.array([0.9, 0.6, 0.7], np.float32))
        assert [round(f.score, 2) for f in faces] == [0.9, 0.7]
        np.testing.assert_allclose(faces[0].box, [0.8, 0, 10.8, 10], atol=1e-5)

    @given(st.lists(st.tuples(*[st.floats(-50, 300)] * 4, st.floats(0, 1)), max_size=30))
    def test_any_boxes(self, rows):
        """Degenerate and repeated boxes give finite faces, no more than there were."""
        values = np.array(rows, np.float32).reshape(-1, 5)
        boxes = np.sort(values[:, :4].reshape(-1, 2, 2), axis=1).reshape(-1, 4)
        faces = _merge(boxes, np.zeros((len(rows), 6, 2), np.float32), values[:, 4])
        assert len(faces) <= len(rows)
        assert bool(faces) == bool(rows)
        assert all(np.isfinite(f.box).all() for f in faces)


class TestTransformed:
    def test_quarter_turn(self):
        """The box is the bounding box of the rotated corners."""
        face = Face(np.array([0, 0, 4, 2], np.float32), np.ones((6, 2), np.float32), 1.0)
        turned = face.transformed(np.array([[0, -1, 0], [1, 0, 0]], np.float32))
        np.testing.assert_allclose(turned.box, [-2, 0, 0, 4])
        np.testing.assert_allclose(turned.points[0], [-1, 1])


@pytest.mark.usefixtures("weights")
class TestDetect:
    @pytest.mark.parametrize("model", ["near", "far"])
    def test_astronaut(self, astronaut, model):
        """One face, its right eye left of the left one, both above the mouth and inside the box."""
        faces = detect(astronaut.pixels, model=model)
        right, left, _, mouth = faces[0].points[:4]
        assert len(faces) == 1
        assert right[0] < left[0]
        assert max(right[1], left[1]) < mouth[1]
        assert faces[0].box[0] < right[0] < left[0] < faces[0].box[2]

    def test_no_face(self):
        """Nothing is found in nothing."""
        assert detect(np.zeros((100, 200, 3), np.float32)) == []

    @pytest.mark.parametrize("shape", [(1, 1), (1, 4000), (4000, 1), (3, 2)])
    def test_any_size(self, shape):
        """Every size down to one pixel has an answer."""
        assert detect(np.ones((*shape, 3), np.float32)) == []
