"""How much of the reference's detail each pixel takes."""

import numpy as np
import pytest

from graphface import GraphfaceError, GraphfaceWarning, load
from graphface.nodes.regions.nine import nine
from graphface.nodes.transfer.mask import mask
from graphface.nodes.types import REGIONS
from graphface.nodes.warp.mesh import mesh as correspond
from graphface.registry import default_registry


@pytest.fixture
def face(make_face):
    photo, landmarks, mesh, surface = make_face(size=200, scale=0.45)
    return nine(photo, landmarks), correspond(surface, mesh, surface, mesh)


class TestMask:
    def test_one_region(self, face):
        """Taking the nose takes the nose, and nothing where there is none of it."""
        regions, correspondence = face
        taken = mask(regions, correspondence, take=("nose",))
        np.testing.assert_allclose(taken, regions.nose * correspondence.inside, atol=1e-6)

    def test_twice_is_once(self, face):
        """A region named twice counts once."""
        regions, correspondence = face
        once, twice = (mask(regions, correspondence, take=take) for take in (("nose",), ("nose", "nose")))
        np.testing.assert_array_equal(once, twice)

    def test_none_is_reported(self, face):
        """An empty list of regions changes nothing, with a warning."""
        regions, correspondence = face
        with pytest.warns(GraphfaceWarning, match="no region"):
            assert mask(regions, correspondence, take=()).max() == 0

    def test_own_strength(self, face):
        """A region's own strength stands in place of the common one."""
        regions, correspondence = face
        taken = mask(regions, correspondence, strength=0.0, strengths={"mouth": 0.5})
        np.testing.assert_allclose(taken, 0.5 * regions.mouth * correspondence.inside, atol=1e-6)

    def test_a_users_mask(self, face):
        """A user's mask is multiplied on top."""
        regions, correspondence = face
        assert mask(regions, correspondence, given=np.zeros_like(regions.nose)).max() == 0

    def test_paint_stays_where_it_is(self, face):
        """What is painted on the reference moves only as far as `painted` says."""
        regions, correspondence = face
        everywhere = np.ones_like(regions.nose)
        assert mask(regions, correspondence, paint=everywhere).max() == 0
        whole, half = (mask(regions, correspondence, paint=everywhere, painted=p) for p in (1.0, 0.5))
        np.testing.assert_array_equal(whole, mask(regions, correspondence))
        np.testing.assert_allclose(half, 0.5 * whole, atol=1e-6)


class TestNames:
    def test_are_those_of_the_regions(self):
        """The schema offers the nine regions, written once in the type `Regions`."""
        schema = default_registry().operator("transfer.mask").parameters.model_json_schema()
        assert schema["properties"]["take"]["items"]["enum"] == list(REGIONS)

    def test_another_name_is_refused(self):
        """A graph that asks for an ear is answered with the regions there are."""
        with pytest.raises(GraphfaceError, match="left_brow"):
            load("transfer", set={"mask.take": ["ear"]})
