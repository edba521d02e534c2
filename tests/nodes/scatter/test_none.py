"""No scattering."""

from __future__ import annotations

from graphface.nodes.scatter.none import none
from graphface.nodes.types import (
    Scene,
)


class TestNone:
    def test_is_the_shading(self, case):
        """The same object."""
        assert none(case.step, case.old, case.surface, case.landmarks, case.photo, Scene(scatter=0.1)) is case.step
