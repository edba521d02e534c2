"""The mask that detail maps are blended by."""

import numpy as np

from graphface.nodes.makeup.keep import keep
from graphface.nodes.types import Features

PARTS = ("eyes", "mouth", "lips", "around", "lids", "brows", "nose", "cheeks")


def one_column_each() -> Features:
    """Each part is 1 in its own column, in the order of PARTS; the last column belongs to none."""
    columns = np.eye(len(PARTS) + 1, dtype=np.float32)
    return Features(**{name: columns[None, k] for k, name in enumerate(PARTS)})


class TestKeep:
    def test_each_part_has_its_share(self):
        """The openings 1, other parts theirs, and cheeks that of everything else."""
        mask = keep(one_column_each(), nose=0.9, lids=0.2, lips=0.5, around=0.4, brows=0.3, elsewhere=0.1)
        np.testing.assert_allclose(mask, [[1, 1, 0.5, 0.4, 0.2, 0.3, 0.9, 0.1, 0.1]])

    def test_openings_are_the_inputs(self, face):
        """In eyes and mouth all of the input's detail stays, whatever the shares."""
        mask = keep(face.features, nose=0, lids=0, lips=0, around=0)
        np.testing.assert_array_equal(mask, face.features.openings)
