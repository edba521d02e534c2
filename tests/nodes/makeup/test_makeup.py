"""The stages of makeup transfer, on faces without photographs; the whole graph on path-traced heads."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from graphface import GraphfaceWarning, UsageError, load
from graphface.nodes.makeup.albedo import albedo
from graphface.nodes.makeup.boundary import boundary
from graphface.nodes.makeup.core import core
from graphface.nodes.makeup.coverage import coverage
from graphface.nodes.makeup.detail import detail
from graphface.nodes.makeup.exposed import exposed
from graphface.nodes.makeup.features import features
from graphface.nodes.makeup.keep import keep
from graphface.nodes.makeup.shading import shading
from graphface.nodes.makeup.skin import skin
from graphface.nodes.makeup.tone import lightness
from graphface.nodes.types import DetailMap, Features, Image, Landmarks, Segmentation
from graphface.nodes.warp.mesh import mesh as correspond


@pytest.fixture
def face(make_face):
    photo, landmarks, mesh, surface = make_face(size=200, scale=0.45)
    return photo, landmarks, mesh, surface, features(photo, landmarks)


class TestFeatures:
    def test_openings_lie_in_their_surroundings(self, face):
        """Eyes lie on the eye's line, the mouth below the nose, lips around the mouth."""
        _, landmarks, _, _, found = face

        def middle(mask):
            return np.average(np.indices(mask.shape)[0], weights=mask)

        assert middle(found.brows) < middle(found.eyes) < middle(found.nose) < middle(found.lips)
        assert found.eyes[tuple(landmarks.points[159, 1::-1].astype(int))] > 0.1

    def test_within_bounds(self, face):
        """Every mask is between 0 and 1, and none is empty."""
        for mask in vars(face[4]).values():
            assert mask.min() >= 0
            assert 0.1 < mask.max() <= 1

    def test_other_points(self, face):
        """68 points do not tell lids from cheeks: an error."""
        with pytest.raises(UsageError, match="facemesh468"):
            features(face[0], Landmarks(np.zeros((68, 3), np.float32), "ibug68"))

    def test_outside_of_the_photo(self, face):
        """A face beyond the frame has no features in it."""
        photo, landmarks, *_ = face
        far = Landmarks(landmarks.points + np.float32(5000), "facemesh468")
        assert max(m.max() for m in vars(features(photo, far)).values()) == 0


class TestTone:
    def test_full_tone_is_the_reference(self, face, rng):
        """At tone 1 the albedo is the reference's but in the openings, where it is the input's."""
        found = face[4]
        own, other = (rng.random((200, 200, 3), np.float32) for _ in range(2))
        painted = albedo(own, other, np.ones((200, 200), np.float32), found)
        opening = np.maximum(found.eyes, found.mouth)
        np.testing.assert_array_equal(painted[opening == 0], other[opening == 0])
        assert np.abs(painted - own)[opening > 0.99].max(initial=0) < 0.05

    def test_no_tone_keeps_the_skins_color(self, face):
        """At tone 0 bare skin has the input's color, and a stripe twice as red stays twice as red."""
        mask = np.ones((200, 200), np.float32)
        own = np.full((200, 200, 3), (1.2, 0.9, 0.9), np.float32)
        other = np.full((200, 200, 3), (1.0, 1.0, 1.0), np.float32)
        other[150:155, :, 0] = 2
        painted = albedo(own, other, mask, face[4], tone=0)
        np.testing.assert_allclose(painted[190, 5], own[190, 5], rtol=1e-4)
        np.testing.assert_allclose(painted[152, 5, 0], 2 * own[152, 5, 0], rtol=1e-4)

    def test_lightness_follows_the_reference(self, face):
        """A reference twice as light doubles the shading, off the openings."""
        ones = np.ones((200, 200), np.float32)
        lit = shading(ones * 0.3, ones * 0.3, ones * 0.6, ones, face[4])
        np.testing.assert_allclose(lit[190, 5], 0.6, rtol=1e-5)

    def test_no_tone_keeps_the_light(self, face):
        """At tone 0 the light is the input's."""
        ones = np.ones((200, 200), np.float32)
        np.testing.assert_allclose(shading(ones * 0.3, ones * 0.3, ones * 0.6, ones, face[4], tone=0), 0.3, rtol=1e-6)

    def test_detail_is_exposed_alike(self):
        """At tone 0 the detail of a reference twice as light is halved."""
        ones = np.ones((4, 4), np.float32)
        scaled = exposed(DetailMap(np.ones((4, 4, 3), np.float32)), ones * 0.3, ones * 0.6, ones, tone=0)
        np.testing.assert_allclose(scaled.offset, 0.5, rtol=1e-5)

    def test_an_empty_mask_is_told(self):
        """Without a face to compare the lightness is taken as equal."""
        with pytest.warns(GraphfaceWarning, match="empty"):
            assert lightness(np.ones((4, 4)), np.ones((4, 4)), np.zeros((4, 4), np.float32)) == 1

    @settings(max_examples=50, deadline=None)
    @given(own=st.floats(0, 1e6, width=32), other=st.floats(0, 1e6, width=32))
    def test_lightness_is_bounded(self, own, other):
        """Black and glaring pictures give a ratio within 1/8 and 8."""
        ones = np.ones((2, 2), np.float32)
        assert 1 / 8 <= lightness(ones * np.float32(own), ones * np.float32(other), ones) <= 8


class TestDetail:
    def test_elsewhere_it_is_the_references(self, face, rng):
        """Far from eyes, nose and mouth the map is the reference's, and in the openings the input's."""
        _, landmarks, _, _, found = face
        own, other = (DetailMap(rng.random((200, 200, 3), np.float32)) for _ in range(2))
        blended = detail(own, other, keep(found), found, landmarks).offset
        np.testing.assert_array_equal(blended[190:, :10], other.offset[190:, :10])
        opening = found.eyes > 0.99
        if opening.any():
            np.testing.assert_allclose(blended[opening], own.offset[opening], atol=0.05)

    def test_broad_differences_pass(self, face):
        """A constant difference (a dark lipstick) is the reference's even where fine detail is kept."""
        _, landmarks, _, _, found = face
        own, other = (DetailMap(np.full((200, 200, 3), v, np.float32)) for v in (0.0, -0.2))
        blended = detail(own, other, keep(found), found, landmarks).offset
        closed = np.maximum(found.eyes, found.mouth) == 0
        np.testing.assert_allclose(blended[closed], -0.2, atol=1e-3)

    def test_thin_lips_are_as_dark_as_the_references(self, face):
        """Lips thinner than what counts as fine get the whole darkness of the lipstick, and the skin beside none."""
        _, landmarks, _, _, found = face
        own, other = np.zeros((200, 200, 3), np.float32), -0.4 * np.dstack([found.lips] * 3)
        blended = detail(DetailMap(own), DetailMap(other), keep(found, lips=1), found, landmarks, fine=0.1).offset
        assert np.median(blended[found.lips > 0.9]) < -0.25
        np.testing.assert_allclose(blended[found.lips < 0.01], 0, atol=0.05)

    def test_equal_maps(self, face, rng):
        """Two equal maps blend to themselves, gain and all."""
        _, landmarks, _, _, found = face
        offset, gain = (rng.random((200, 200, 3), np.float32) for _ in range(2))
        blended = detail(DetailMap(offset, gain), DetailMap(offset, gain), keep(found), found, landmarks)
        np.testing.assert_allclose(blended.offset, offset, atol=1e-6)
        np.testing.assert_allclose(blended.gain, gain, atol=1e-6)


class TestSkin:
    def test_painted_skin_is_skin(self, face):
        """In the middle of the mesh nothing but hair takes the paint away."""
        _, landmarks, _, surface, found = face
        nothing = np.zeros((200, 200), np.float32)
        middle = tuple(landmarks.points[4, 1::-1].astype(int))
        labels = Segmentation(face=nothing, hair=nothing, background=nothing + 1)
        assert skin(labels, surface, landmarks, found)[middle] > 0.9
        labels = Segmentation(face=nothing, hair=nothing + 1, background=nothing)
        assert skin(labels, surface, landmarks, found).max() == 0

    def test_given(self, face):
        """A user's mask is taken as it is."""
        _, landmarks, _, surface, found = face
        mask = np.full((200, 200), 0.25, np.float32)
        assert skin(Segmentation(mask, mask, mask), surface, landmarks, found, mask) is mask


class TestCoverage:
    def test_regions_have_their_own_strength(self, face):
        """Lips alone: nothing else is covered."""
        found = face[4]
        covered = coverage(np.ones((200, 200), np.float32), found, lids=0, brows=0, cheeks=0, base=0)
        assert covered[found.lips > 0.95].min() > 0.9
        assert covered[190:, :10].max() == 0

    @settings(max_examples=20, deadline=None)
    @given(strength=st.floats(0, 1), base=st.floats(0, 1))
    def test_never_more_than_the_skin(self, strength, base):
        """Coverage lies between 0 and the skin mask."""
        nothing = np.zeros((4, 4), np.float32)
        found = Features(*[nothing] * 8)
        mask = np.linspace(0, 1, 16, dtype=np.float32).reshape(4, 4)
        covered = coverage(mask, found, strength=strength, base=base)
        assert covered.min() >= 0
        assert (covered <= mask + 1e-6).all()


class TestCore:
    def test_a_brow_is_whole_or_not_there(self, face):
        """Where hair hides half of a brow of the reference, the whole brow stays the input's; the other is painted."""
        _, landmarks, mesh, surface, found = face
        ones = np.ones((200, 200), np.float32)
        half = ones.copy()
        half[:, : int(landmarks.points[105, 0])] = 0
        whole = correspond(surface, mesh, surface, mesh, ones, half, hidden="input")
        inner = core(ones, ones, whole, landmarks, found)
        brows = found.brows > 0.5
        left = np.arange(200) < landmarks.points[168, 0]
        assert inner[brows & left].max() == 0
        assert inner[brows & ~left].mean() > 0.5

    def test_nothing_is_painted_on_what_is_in_front(self, face):
        """Where something is in front of the skin, the core ends."""
        _, landmarks, mesh, surface, found = face
        ones = np.ones((200, 200), np.float32)
        same = correspond(surface, mesh, surface, mesh)
        assert core(ones, ones, same, landmarks, found, ones).max() == 0


class TestBoundary:
    def test_no_change_stays_none(self, face):
        """Where painting changed nothing, nothing changes beyond it either."""
        photo, landmarks, mesh, surface, found = face
        ones = np.ones((200, 200), np.float32)
        inner = core(ones, ones, correspond(surface, mesh, surface, mesh), landmarks)
        np.testing.assert_allclose(boundary(photo, photo, inner, found, landmarks).pixels, photo.pixels, atol=1e-4)

    def test_a_tone_continues(self, face):
        """A face made darker makes the neck darker by about as much, and there is no step between them."""
        _, landmarks, mesh, surface, found = face
        ones = np.ones((200, 200), np.float32)
        photo, painted = (Image(np.full((200, 200, 3), v, np.float32)) for v in (0.6, 0.3))
        inner = core(ones, ones, correspond(surface, mesh, surface, mesh), landmarks)
        layer = boundary(photo, painted, inner, found, landmarks).pixels
        np.testing.assert_allclose(layer, 0.3, atol=0.06)
        assert np.abs(np.diff(layer[..., 0], axis=0)).max() < 0.03

    def test_brighter_skin_is_not_coarser(self, face, rng):
        """Beyond the painted face grain keeps its strength where the tone gets brighter: it is added, not scaled."""
        _, landmarks, mesh, surface, found = face
        ones = np.ones((200, 200), np.float32)
        grain = 0.01 * rng.standard_normal((200, 200, 1)).astype(np.float32).repeat(3, axis=2)
        photo, painted = Image(0.25 + grain), Image(0.6 + grain)
        inner = core(ones, ones, correspond(surface, mesh, surface, mesh), landmarks)
        layer = boundary(photo, painted, inner, found, landmarks).pixels
        beyond = inner == 0
        assert layer[beyond].mean() > 0.5
        assert np.diff(layer, axis=0)[beyond[1:]].std() < 1.3 * np.diff(photo.pixels, axis=0)[beyond[1:]].std()

    def test_teeth_keep_their_color(self, face):
        """Where a mouth is not painted the skin's new tone does not reach into it."""
        photo, landmarks, mesh, surface, found = face
        ones = np.ones((200, 200), np.float32)
        photo, painted = (Image(np.full((200, 200, 3), v, np.float32)) for v in (0.3, 0.6))
        inner = core(ones, ones, correspond(surface, mesh, surface, mesh), landmarks) * (found.mouth == 0)
        layer = boundary(photo, painted, inner, found, landmarks).pixels
        opening = found.mouth > 0.99 * found.mouth.max()
        assert np.abs(layer - photo.pixels)[opening].max() < 0.3 * (1.1 - found.mouth.max()) + 1e-6
        assert layer[found.lips > 0.95].mean() > 0.5

    def test_nothing_in_common_is_told(self, face):
        """Without any known pixel nothing is painted, and the photo comes back."""
        photo, landmarks, mesh, surface, found = face
        nothing = np.zeros((200, 200), np.float32)
        with pytest.warns(GraphfaceWarning, match="nothing is painted"):
            inner = core(nothing, nothing, correspond(surface, mesh, surface, mesh), landmarks)
        assert boundary(photo, photo, inner, found, landmarks) is photo


@pytest.mark.filterwarnings("ignore::graphface.GraphfaceWarning")
class TestGraph:
    @pytest.mark.parametrize(
        "name", ["pd_roy-blunt.jpg", "pd_raul-grijalva.jpg"]
    )  # the second with glasses and a beard
    def test_a_face_onto_itself(self, shared, name):
        """Self-transfer returns the photo within 2/255."""
        photo = shared / "faces" / name
        made = load("makeup").run(["image", "pair.working"], photo=photo, reference=photo)
        assert np.abs(made["image"].pixels - made["pair.working"].pixels).max() <= 2 / 255

    def test_every_picture_of_the_figure(self, shared):
        """Albedos, rendered shading, detail maps and masks come out by name; without detail, painted is rendered."""
        faces = shared / "faces"
        names = ["input_albedo", "reference_albedo", "albedo", "shading", "rendered", "input_detail", "detail", "keep"]
        names += ["reference_detail", "reference_warped", "core", "coverage", "painted", "image"]
        made = load("makeup").run(names, photo=faces / "nm_sm1.jpg", reference=faces / "wild_csd00012.jpg")
        core = made["core"] > 0.9
        plain = np.clip(made["painted"].pixels - made["detail"].offset, 0, 1)
        assert np.median(np.abs(plain - made["rendered"].pixels)[core]) < 1e-3

    def test_no_strength_no_change(self, shared):
        """Strength 0 returns the input to the last bit."""
        faces = shared / "faces"
        graph = load("makeup", set={"coverage.strength": 0})
        made = graph.run(["image", "pair.working"], photo=faces / "nm_sm1.jpg", reference=faces / "wild_sm1.jpg")
        np.testing.assert_array_equal(made["image"].pixels, made["pair.working"].pixels)
