"""A texture put back onto a face."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from faces import fitted

from graphface import UsageError
from graphface.nodes.texture.project import project
from graphface.nodes.texture.unwrap import unwrap


class TestProject:
    def test_goes_there_and_back(self):
        """Unwrapping and putting back changes the photo's face by little, and nothing else."""
        photo, mesh, surface = fitted(15)
        back = project(unwrap(photo, mesh, surface, size=512), photo, mesh, surface)
        apart = np.abs(back.pixels - photo.pixels)
        assert apart[surface.coverage > 0].mean() < 0.01
        assert not apart[surface.coverage == 0].any()

    def test_what_was_not_seen_stays(self):
        """A texture of one half of a face leaves the other half of a photo as it is."""
        photo, mesh, surface = fitted(60)
        texture = unwrap(photo.with_pixels(photo.pixels * 0), mesh, surface)
        front, front_mesh, front_surface = fitted(0)
        change = np.abs(project(texture, front, front_mesh, front_surface).pixels - front.pixels).max(axis=2)
        left, right = (
            change[:, half][front_surface.coverage[:, half] > 0].mean() for half in (np.s_[:185], np.s_[215:])
        )
        assert max(left, right) > 5 * min(left, right)

    def test_a_mesh_without_coordinates_is_refused(self):
        """The user is told which geometry has them."""
        photo, mesh, surface = fitted()
        texture = unwrap(photo, mesh, surface, size=8)
        with pytest.raises(UsageError, match=r"geometry\.morphable"):
            project(texture, photo, replace(mesh, uv=None), surface)
