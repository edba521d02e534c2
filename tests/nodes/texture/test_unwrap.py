"""A photo unwrapped onto the model's texture."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from faces import fitted
from hypothesis import given, settings
from hypothesis import strategies as st

from graphface import GraphfaceWarning
from graphface.nodes.surface.rasterize import rasterize
from graphface.nodes.texture.unwrap import unwrap
from graphface.nodes.types import Camera


class TestUnwrap:
    def test_hidden_texels_are_not_fitted(self):
        """The far half of a turned face is marked as not seen, and left alone on another photo."""
        photo, mesh, surface = fitted(60)
        texture = unwrap(photo, mesh, surface)
        half = texture.seen.shape[1] // 2
        assert texture.seen[:, :half].sum() > 3 * texture.seen[:, half:].sum()

    def test_no_face_in_the_frame_is_reported(self):
        """An empty texture comes with a warning."""
        photo, mesh, _ = fitted()
        away = replace(mesh, camera=Camera(center=(-5000.0, 0.0)))
        with pytest.warns(GraphfaceWarning):
            texture = unwrap(photo, away, rasterize(away, photo))
        assert not texture.seen.any()
        assert np.isfinite(texture.image.pixels).all()

    @given(st.integers(8, 80), st.floats(-40, 40))
    @settings(max_examples=6, deadline=None)
    def test_any_size(self, size, yaw):
        """Small textures too are finite and within the photo's range."""
        photo, mesh, surface = fitted(yaw)
        texture = unwrap(photo, mesh, surface, size=size)
        assert texture.image.pixels.shape == (size, size, 3)
        assert 0 <= texture.image.pixels.min() <= texture.image.pixels.max() <= photo.pixels.max()
