"""The search over views: each maps back to the photo, and the search ends early."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from graphface.nodes.landmarks import search as module
from graphface.nodes.landmarks.blazeface import Face
from graphface.nodes.landmarks.search import SURE, distinct, search
from graphface.nodes.types import Image


def face(x: float, y: float, size: float, score: float) -> Face:
    half = size / 2
    return Face(np.array([x - half, y - half, x + half, y + half], np.float32), np.zeros((6, 2), np.float32), score)


class TestViews:
    @settings(deadline=None, max_examples=25)
    @given(st.integers(1, 700), st.integers(1, 700), st.data())
    def test_every_view_maps_back(self, height, width, data):
        """A bright pixel of the photo, found in any view that has it, maps back onto itself."""
        y, x = data.draw(st.integers(0, height - 1)), data.draw(st.integers(0, width - 1))
        pixels = np.zeros((height, width, 3), np.float32)
        pixels[y, x] = 1
        for views in module._views(Image(pixels), thorough=False):
            for view in views:
                rows, columns = np.nonzero(view.pixels[..., 0] > 0.5)
                for row, column in zip(rows, columns, strict=True):
                    place = view.matrix[:, :2] @ (column, row) + view.matrix[:, 2]
                    np.testing.assert_allclose(place, (x, y), atol=1e-3)

    def test_large_photos_are_searched_small(self):
        """No view is larger than the reduced copy with its border, and the copy's corner maps to the photo's."""
        views = next(module._views(Image(np.zeros((10, 4000, 3), np.float32)), thorough=False))
        assert max(views[0].pixels.shape) == module.LONG_SIDE
        np.testing.assert_allclose(
            views[0].matrix[:, :2] @ (-0.5, -0.5) + views[0].matrix[:, 2], (-0.5, -0.5), atol=1e-4
        )


class TestDistinct:
    def test_the_better_of_two_overlapping(self):
        """The same face from two views is one face, the better one."""
        faces = distinct([face(50, 50, 40, 0.6), face(55, 52, 44, 0.9)])
        assert [f.score for f in faces] == [0.9]

    def test_largest_first(self):
        """Faces come in order of size."""
        sizes = [f.size for f in distinct([face(50, 50, 20, 0.9), face(200, 50, 60, 0.6), face(400, 50, 40, 0.8)])]
        assert sizes == [60, 40, 20]


class TestSearch:
    PHOTO = Image(np.zeros((64, 64, 3), np.float32))

    @pytest.fixture
    def detections(self, monkeypatch) -> list[list[Face]]:
        """The results of the detector, call by call; none after the end of the list."""
        answers: list[list[Face]] = []
        monkeypatch.setattr(module, "detect", lambda *_, **__: answers.pop(0) if answers else [])
        return answers

    def test_a_certain_face_ends_it(self, detections):
        """After a confirmed face with a good score no other view is tried."""
        detections.extend([[face(30, 30, 20, SURE + 0.1)], []])
        found, tried = search(self.PHOTO, lambda f: f.score, min_score=0.5)
        assert (len(found), len(tried)) == (1, 1)

    def test_a_weak_face_is_compared(self, detections):
        """A weak face is compared with the view with a border, and the better one is taken."""
        detections.extend([[face(30, 30, 20, 0.55)], [], [face(64, 64, 60, 0.9)], []])
        found, tried = search(self.PHOTO, lambda f: round(f.score, 2), min_score=0.5)
        assert (found, len(tried)) == ([0.9], 2)

    def test_a_weak_face_alone(self, detections):
        """A weak face is taken where no other is found."""
        detections.extend([[face(30, 30, 20, 0.55)]])
        found, _ = search(self.PHOTO, lambda f: round(f.score, 2), min_score=0.5)
        assert found == [0.55]

    def test_unconfirmed_faces_do_not_count(self, detections):
        """After false detections alone every view is tried."""
        detections.extend([[face(30, 30, 20, 0.9)]])
        found, tried = search(self.PHOTO, lambda f: None, min_score=0.5)
        assert found == []
        assert tried[0] == "as it is"
        assert tried[-1] == "upside down"
