"""The reference's detail map in the exposure of the painted face."""

import numpy as np

from graphface.nodes.makeup.exposed import exposed
from graphface.nodes.types import DetailMap

ONES = np.ones((4, 4), np.float32)
MAP = DetailMap(np.ones((4, 4, 3), np.float32), pivot=np.full((4, 4, 3), 0.4, np.float32))


class TestExposed:
    def test_no_tone(self):
        """At tone 0 offset and pivot of a reference twice as light are halved."""
        scaled = exposed(MAP, ONES * 0.3, ONES * 0.6, ONES, tone=0)
        np.testing.assert_allclose(scaled.offset, 0.5, rtol=1e-5)
        np.testing.assert_allclose(scaled.pivot, 0.2, rtol=1e-5)

    def test_full_tone(self):
        """At tone 1 the face is rendered as light as the reference, and the very map is returned."""
        assert exposed(MAP, ONES * 0.3, ONES * 0.6, ONES) is MAP
