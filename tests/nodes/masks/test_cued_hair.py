"""Hair of a segmentation."""

from __future__ import annotations

import numpy as np
from portraits import portrait
from stages import certain, masks_of

from graphface.nodes.masks.cued_hair import cued_hair


class TestCuedHair:
    def test_the_mask_is_within_the_normal_one(self):
        """Hair beyond the head is in the response and not in the mask."""
        photo, landmarks, labels = portrait()
        masks = masks_of(photo, landmarks)
        found = cued_hair(certain(np.ones_like(labels)), masks)
        assert (found.response == 1).all()
        np.testing.assert_array_equal(found.mask, masks.normal)
