"""The window about a face."""

from __future__ import annotations

import numpy as np
from hypothesis import given
from hypothesis import strategies as st
from portraits import landmarks_at

from graphface.nodes.masks.window import window_about


class TestWindowAbout:
    @given(
        st.integers(1, 400),
        st.integers(1, 400),
        st.floats(-1e4, 1e4),
        st.floats(-1e4, 1e4),
        st.floats(0.01, 5e3),
        st.floats(-3, 3),
    )
    def test_lies_within_the_frame(self, height, width, x, y, interocular, roll):
        """Whatever the face, a window of at least one pixel within the photo."""
        window = window_about(landmarks_at(x, y, interocular, roll), (height, width), 40)
        assert 0 <= window.top < window.bottom <= height
        assert 0 <= window.left < window.right <= width
        assert window.height >= 1
        assert window.width >= 1

    def test_resolution(self):
        """The inter-ocular distance has as many pixels as asked for, and never more than the photo gives."""
        shape = (3000, 3000)
        large, small = (window_about(landmarks_at(1500, 1500, s), shape, 40) for s in (200.0, 20.0))
        assert abs(200 * large.scale - 40) < 0.5
        assert small.scale == 1

    def test_cost_follows_the_face(self):
        """A small face in a huge photo has a small window."""
        window = window_about(landmarks_at(2000, 2000, 30), (4000, 4000), 40)
        assert window.height * window.width < 40_000

    def test_there_and_back(self):
        """A map that is downsampled and upsampled again lies where it was."""
        window = window_about(landmarks_at(300, 300, 80), (600, 600), 40)
        x = np.broadcast_to(np.arange(600, dtype=np.float32), (600, 600))
        back = window.upsampled(window.downsampled(x), (600, 600), outside=-1)
        rows, columns = window.part
        inner = np.s_[rows.start + 5 : rows.stop - 5, columns.start + 5 : columns.stop - 5]
        np.testing.assert_allclose(back[inner], x[inner], atol=0.6)
        np.testing.assert_allclose(window.downsampled(x)[0], window.positions()[0][0], atol=0.6)
