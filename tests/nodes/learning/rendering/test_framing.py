"""How a head is held before the camera, and where the camera stands."""

from __future__ import annotations

import numpy as np

from graphface.nodes.learning.rendering.framing import framed, turned
from graphface.nodes.learning.rendering.person import dressed, expressed, random_shape


class TestTurned:
    def test_keeps_the_shape(self, head):
        """Turned by the angles that are told, less by a smaller scale; no distance changes."""
        random = np.random.default_rng(3)
        body, landmarks = expressed(head, dressed(head, random_shape(head, random), random), {})
        (_, much, angles), (_, little, fewer) = (
            turned(body, landmarks, np.random.default_rng(5), scale=scale) for scale in (1.0, 0.25)
        )
        np.testing.assert_allclose(list(fewer.values()), 0.25 * np.array(list(angles.values())))
        eyes = [np.linalg.norm(points[36] - points[45]) for points in (landmarks, much, little)]
        np.testing.assert_allclose(eyes, eyes[0])


class TestFramed:
    def test_room(self, head):
        """The face lies within the picture, and is smaller where there is more room."""
        landmarks = head.mean[head.landmarks]
        heights = []
        for room in (1.0, 1.5):
            view = framed(landmarks, np.random.default_rng(1), 100, room=room)
            seen = view.seen(landmarks)[:, :2]
            assert abs(seen).max() < 65
            heights.append(np.ptp(seen[:, 1]))
        np.testing.assert_allclose(heights[0] / heights[1], 1.5, rtol=0.05)
