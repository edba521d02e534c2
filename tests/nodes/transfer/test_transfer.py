"""Detail transfer of nine regions."""

from typing import get_args

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from graphface import GraphfaceWarning, load
from graphface.nodes.makeup.features import features
from graphface.nodes.regions.atlas import NAMES
from graphface.nodes.regions.nine import nine
from graphface.nodes.transfer.detail import detail
from graphface.nodes.transfer.mask import Region, mask
from graphface.nodes.transfer.paint import paint
from graphface.nodes.transfer.recolored import recoloured
from graphface.nodes.types import DetailMap, Image, Landmarks
from graphface.nodes.warp.mesh import mesh as correspond

ONES = np.ones((60, 60), np.float32)
POINTS = np.zeros((468, 3), np.float32)
POINTS[263, 0] = 40


@pytest.fixture
def face(make_face):
    photo, landmarks, mesh, surface = make_face(size=200, scale=0.45)
    return nine(photo, landmarks), correspond(surface, mesh, surface, mesh), landmarks


class TestMask:
    def test_names_are_those_of_the_regions(self):
        """The names that `take` accepts are the nine regions."""
        assert set(get_args(Region)) == set(NAMES)

    def test_one_region(self, face):
        """Taking the nose takes the nose, and nothing where there is none of it."""
        nine, correspondence, _ = face
        taken = mask(nine, correspondence, take=("nose",))
        np.testing.assert_allclose(taken, nine.nose * correspondence.inside, atol=1e-6)

    def test_twice_is_once(self, face):
        """A region named twice counts once."""
        nine, correspondence, _ = face
        once, twice = (mask(nine, correspondence, take=take) for take in (("nose",), ("nose", "nose")))
        np.testing.assert_array_equal(once, twice)

    def test_none_is_told(self, face):
        """An empty list of regions changes nothing, and says so."""
        nine, correspondence, _ = face
        with pytest.warns(GraphfaceWarning, match="no region"):
            assert mask(nine, correspondence, take=()).max() == 0

    def test_own_strength(self, face):
        """A region's own strength stands in place of the common one."""
        nine, correspondence, _ = face
        taken = mask(nine, correspondence, strength=0.0, strengths={"mouth": 0.5})
        np.testing.assert_allclose(taken, 0.5 * nine.mouth * correspondence.inside, atol=1e-6)

    def test_a_users_mask(self, face):
        """A user's mask is multiplied on top."""
        nine, correspondence, _ = face
        assert mask(nine, correspondence, given=np.zeros_like(nine.nose)).max() == 0

    def test_paint_stays_where_it_is(self, face):
        """What is painted on the reference moves only as far as `painted` says."""
        nine, correspondence, _ = face
        everywhere = np.ones_like(nine.nose)
        assert mask(nine, correspondence, paint=everywhere).max() == 0
        whole, half = (mask(nine, correspondence, paint=everywhere, painted=p) for p in (1.0, 0.5))
        np.testing.assert_array_equal(whole, mask(nine, correspondence))
        np.testing.assert_allclose(half, 0.5 * whole, atol=1e-6)


class TestPaint:
    def test_another_skin_is_no_paint(self):
        """Two even skins of different colors: nothing is painted."""
        one, other = (Image(np.tile(np.float32(c), (60, 60, 1))) for c in ((0.7, 0.5, 0.3), (0.9, 0.8, 0.7)))
        assert paint(one, other, ONES, Landmarks(POINTS, "facemesh468")).max() == 0

    def test_a_red_lip_on_a_bare_one(self):
        """A patch that only the reference has in another color is paint; beside it is none."""
        one = np.full((60, 60, 3), 0.5, np.float32)
        other = one.copy()
        other[20:40, 20:40] = (0.8, 0.2, 0.2)
        found = paint(Image(one), Image(other), ONES, Landmarks(POINTS, "facemesh468"))
        assert found[25:35, 25:35].min() > 0.99
        assert found[:10].max() == 0

    def test_without_a_face(self):
        """An empty mask has no skin to compare with: no paint."""
        one = Image(np.ones((60, 60, 3), np.float32))
        assert paint(one, one, 0 * ONES, Landmarks(POINTS, "facemesh468")).max() == 0

    @settings(max_examples=20, deadline=None)
    @given(seed=st.integers(0, 1000), dark=st.floats(0, 1), faint=st.floats(0, 2), full=st.floats(0.01, 2))
    def test_a_mask(self, seed, dark, faint, full):
        """Between 0 and 1 whatever the colors, black included, and whatever order the thresholds have."""
        draw = np.random.default_rng(seed)
        one, other = (Image(draw.random((60, 60, 3), np.float32) * np.float32(dark)) for _ in range(2))
        found = paint(one, other, ONES, Landmarks(POINTS, "facemesh468"), faint=faint, full=full)
        assert found.min() >= 0
        assert found.max() <= 1


class TestDetail:
    def test_no_mask_no_change(self, face, rng):
        """Without a mask the very map comes back."""
        _, _, landmarks = face
        own, other = (DetailMap(rng.random((200, 200, 3), np.float32)) for _ in range(2))
        assert detail(own, other, np.zeros((200, 200), np.float32), landmarks) is own

    def test_everything(self, face, rng):
        """With all frequencies and a full mask it is the reference's map."""
        _, _, landmarks = face
        own, other = (DetailMap(rng.random((200, 200, 3), np.float32)) for _ in range(2))
        got = detail(own, other, np.ones((200, 200), np.float32), landmarks, broadest=None)
        np.testing.assert_allclose(got.offset, other.offset, atol=1e-6)

    def test_broad_light_stays(self, face):
        """A constant difference, which is light, does not move."""
        _, _, landmarks = face
        own, other = (DetailMap(np.full((200, 200, 3), v, np.float32)) for v in (0.0, 0.3))
        got = detail(own, other, np.ones((200, 200), np.float32), landmarks, broadest=0.2)
        np.testing.assert_allclose(got.offset, 0, atol=1e-3)

    def test_lips_stay_as_dark_as_they_are(self, face):
        """A neutral lipstick darkens all of the lips, which is no relief; the lines in them are."""
        landmarks = face[2]
        parts = features(Image(np.zeros((200, 200, 3), np.float32)), landmarks)
        lines = (np.arange(200) % 4 < 2).astype(np.float32)[None, :, None] * 0.1
        own, dark = np.zeros((200, 200, 3), np.float32), -0.3 * np.dstack([parts.lips] * 3)
        full, sure = np.ones((200, 200), np.float32), parts.lips > 0.9
        told, untold = (
            detail(DetailMap(own), DetailMap(dark + lines), full, landmarks, found).offset for found in (parts, None)
        )
        assert abs(told[sure].mean()) < 0.1
        assert untold[sure].mean() < -0.2
        assert told[sure].std() > 0.04

    def test_what_is_too_fine_stays(self, face, rng):
        """Below the finest scale, noise of the reference is not taken."""
        _, _, landmarks = face
        own, noise = (
            DetailMap(np.zeros((200, 200, 3), np.float32)),
            DetailMap(rng.standard_normal((200, 200, 3), np.float32)),
        )
        got = detail(own, noise, np.ones((200, 200), np.float32), landmarks, broadest=None, finest=0.1)
        assert got.offset.std() < 0.1 * noise.offset.std()

    @settings(max_examples=30, deadline=None)
    @given(
        height=st.integers(1, 24),
        width=st.integers(1, 24),
        broadest=st.one_of(st.none(), st.floats(0.01, 2)),
        finest=st.floats(0, 2),
        eyes=st.floats(0, 50),
    )
    def test_any_size_is_finite(self, height, width, broadest, finest, eyes):
        """Single pixels and coincident eyes: finite."""
        random = np.random.default_rng(1)
        own, other = (DetailMap(random.random((height, width, 3), np.float32)) for _ in range(2))
        landmarks = Landmarks(np.zeros((468, 3), np.float32), "facemesh468")
        landmarks.points[263, 0] = eyes
        got = detail(
            own, other, random.random((height, width), np.float32), landmarks, broadest=broadest, finest=finest
        )
        assert np.isfinite(got.offset).all()


class TestRecolored:
    def test_equal_albedo(self, rng):
        """On skin of the same color, a map that is rho (s - SH) stays as it is."""
        rho, light = rng.random((4, 4, 3), np.float32) + 0.5, rng.standard_normal((4, 4, 1), np.float32)
        np.testing.assert_allclose(recoloured(DetailMap(rho * light), rho, rho).offset, rho * light, rtol=1e-4)

    def test_equal_albedo_darker_than_the_floor(self, rng):
        """On skin of the same color any map stays as it is to the last bit, however dark the albedo."""
        rho, offset = (rng.random((4, 4, 3), np.float32) * np.float32(0.1) for _ in range(2))
        np.testing.assert_array_equal(recoloured(DetailMap(offset), rho, rho).offset, offset)

    def test_takes_the_inputs_color(self):
        """The shadow of red lips on grey skin is grey."""
        red, skin = (np.full((2, 2, 3), c, np.float32) for c in ((2.6, 0.2, 0.2), (1.0, 1.0, 1.0)))
        got = recoloured(DetailMap(-0.3 * red), red, skin).offset
        np.testing.assert_allclose(got, -0.3, rtol=1e-5)

    @settings(max_examples=50, deadline=None)
    @given(own=st.floats(0, 1e3, width=32), other=st.floats(0, 1e3, width=32))
    def test_black_is_not_divided_by(self, own, other):
        """Black albedos give finite detail: the floor bounds what is added."""
        ones = np.ones((1, 1, 3), np.float32)
        got = recoloured(DetailMap(ones), ones * np.float32(other), ones * np.float32(own)).offset
        assert np.isfinite(got).all()
        assert (np.abs(got) <= 1 + 10.01 * abs(own - other)).all()


@pytest.mark.filterwarnings("ignore::graphface.GraphfaceWarning")
class TestGraph:
    @pytest.mark.parametrize("name", ["nm_sm1.jpg", "pd_raul-grijalva.jpg"])  # the second with glasses and a beard
    def test_a_face_onto_itself(self, shared, name):
        """All nine regions of a face onto itself return the photo within 2/255."""
        photo = shared / "faces" / name
        made = load("transfer").run(["image", "pair.working"], photo=photo, reference=photo)
        assert np.abs(made["image"].pixels - made["pair.working"].pixels).max() <= 2 / 255

    def test_only_what_was_asked_for(self, shared):
        """Taking the nose leaves every pixel off the nose as it is."""
        faces = shared / "faces"
        graph = load("transfer", set={"mask.take": ["nose"]})
        asked = ["image", "mask", "pair.working"]
        made = graph.run(asked, photo=faces / "nm_sm1.jpg", reference=faces / "pd_roy-blunt.jpg")
        change = np.abs(made["image"].pixels - made["pair.working"].pixels).max(axis=2)
        assert change[made["mask"] == 0].max() < 1e-3
        assert change[made["mask"] > 0.9].mean() > 0.01
