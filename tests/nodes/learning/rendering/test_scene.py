"""The scene for mitsuba."""

from __future__ import annotations

import builtins

import numpy as np
import pytest

from graphface import UsageError
from graphface.nodes.learning.rendering.scene import View, mitsuba


class TestView:
    def test_pixels(self):
        """The rasterizer's camera sees a point where the pinhole does."""
        view = View(np.array([1.0, 2, 100]), np.eye(3), 300.0, 64, 90.0)
        point = np.array([[3.0, -1, 15]])
        mesh = view.mesh(point, np.zeros((0, 3), np.int32), np.array([[0.0, 0, 1]]), 9.0)
        expected = [31.5 + 300 * 2 / 85, 31.5 + 300 * 3 / 85]
        np.testing.assert_allclose(mesh.camera.project(mesh.vertices.astype(float))[0], expected, rtol=1e-5)
        assert mesh.interocular == pytest.approx(30)


class TestMitsuba:
    def test_missing(self, monkeypatch):
        """Without mitsuba the message says what to install."""

        def without(name, *rest, **more):
            if name in ("drjit", "mitsuba"):
                raise ImportError(name)
            return imported(name, *rest, **more)

        imported = builtins.__import__
        mitsuba.cache_clear()
        monkeypatch.setattr(builtins, "__import__", without)
        with pytest.raises(UsageError, match=r"graphface\[truth\]"):
            mitsuba()
