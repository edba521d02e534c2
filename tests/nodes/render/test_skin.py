"""Skin that scatters light or not."""

from __future__ import annotations

import numpy as np
import pytest

from graphface import UsageError
from graphface.nodes.render.skin import skin
from graphface.nodes.types import (
    Scene,
)

SHAPE = (6, 9)


OLD, NEW = np.full(SHAPE, 0.4, np.float32), np.full(SHAPE, 0.8, np.float32)


class TestSkin:
    def test_chooses_by_the_scene(self):
        """Scattered only where the scene scatters."""
        assert skin(Scene(), shading=OLD) is OLD
        assert skin(Scene(scatter=0.1), scattered=NEW) is NEW

    def test_says_what_is_missing(self):
        """Called without what it needs."""
        with pytest.raises(UsageError, match="needs the shading"):
            skin(Scene())
