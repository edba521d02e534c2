"""Where the reference wears makeup."""

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st
from portraits import eyes_apart

from graphface.nodes.transfer.paint import paint
from graphface.nodes.types import Image

ONES = np.ones((60, 60), np.float32)


class TestPaint:
    def test_another_skin_is_not_paint(self):
        """Two even skins of different colors: no paint."""
        one, other = (Image(np.tile(np.float32(c), (60, 60, 1))) for c in ((0.7, 0.5, 0.3), (0.9, 0.8, 0.7)))
        assert paint(one, other, ONES, eyes_apart(40)).max() == 0

    def test_a_red_lip_on_a_bare_one(self):
        """A patch that only the reference has in another color is paint; beside it is none."""
        one = np.full((60, 60, 3), 0.5, np.float32)
        other = one.copy()
        other[20:40, 20:40] = (0.8, 0.2, 0.2)
        found = paint(Image(one), Image(other), ONES, eyes_apart(40))
        assert found[25:35, 25:35].min() > 0.99
        assert found[:10].max() == 0

    def test_without_a_face(self):
        """An empty mask has no skin to compare with: no paint."""
        one = Image(np.ones((60, 60, 3), np.float32))
        assert paint(one, one, 0 * ONES, eyes_apart(40)).max() == 0

    @settings(max_examples=20, deadline=None)
    @given(seed=st.integers(0, 1000), dark=st.floats(0, 1), faint=st.floats(0, 2), full=st.floats(0.01, 2))
    def test_a_mask(self, seed, dark, faint, full):
        """Between 0 and 1 whatever the colors, black included, and whatever order the thresholds have."""
        draw = np.random.default_rng(seed)
        one, other = (Image(draw.random((60, 60, 3), np.float32) * np.float32(dark)) for _ in range(2))
        found = paint(one, other, ONES, eyes_apart(40), faint=faint, full=full)
        assert found.min() >= 0
        assert found.max() <= 1
