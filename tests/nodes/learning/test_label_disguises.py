"""People in disguise, whose labels stay known."""

from __future__ import annotations

import numpy as np
from drawn import PICTURE, drawn_person
from hypothesis import given, settings
from hypothesis import strategies as st

from graphface.nodes.learning.label_disguises import (
    bare_shouldered,
    disguised,
    dyed,
    reshaped,
    with_hair_of,
    with_scarf,
)


def clothed_person():
    """Everything below the head that is not face is clothes."""
    own = drawn_person()
    own.person[60:] = 1
    return own


class TestDisguised:
    @given(st.integers(0, 10_000))
    @settings(max_examples=40, deadline=None)
    def test_any(self, seed):
        """Colors can be displayed, labels stay within 0 and 1 and within the person."""
        found = disguised(drawn_person(), [PICTURE], np.random.default_rng(seed))
        for values in (found.pixels, found.labels, found.person):
            assert np.isfinite(values).all()
            assert values.min() >= -1e-5
            assert values.max() <= 1 + 1e-5
        assert (found.labels.sum(axis=2) <= found.person + 0.05).all()

    def test_nothing_is_changed_in_place(self):
        """The person that was given stays as it was."""
        own, again = drawn_person(), drawn_person()
        for seed in range(20):
            disguised(own, [PICTURE], np.random.default_rng(seed))
        np.testing.assert_array_equal(own.pixels, again.pixels)
        np.testing.assert_array_equal(own.labels, again.labels)


class TestHair:
    def test_borrowed(self):
        """Hair of another head is hair wherever it lies, and no hair is lost."""
        own = drawn_person()
        found = with_hair_of(own, PICTURE, np.random.default_rng(0))
        assert found.labels[..., 1].sum() >= own.labels[..., 1].sum()
        assert (found.labels[..., 1] >= own.labels[..., 1] - 1e-5).all()

    def test_dyed(self):
        """Hair changes its color, face and backdrop keep theirs."""
        own = drawn_person()
        found = dyed(own, np.random.default_rng(1))
        hair, rest = own.labels[..., 1] > 0.99, own.labels[..., 1] == 0
        assert np.abs(found.pixels - own.pixels)[hair].mean() > 0.05
        np.testing.assert_allclose(found.pixels[rest], own.pixels[rest], atol=0.01)
        np.testing.assert_array_equal(found.labels, own.labels)

    def test_scarf(self):
        """Cloth over the hair is background, the face below it stays."""
        own = drawn_person()
        found = with_scarf(own, np.random.default_rng(2))
        assert found.labels[..., 1].sum() < 0.1 * own.labels[..., 1].sum()
        assert found.labels[..., 0].sum() > 0.7 * own.labels[..., 0].sum()


class TestBareShouldered:
    def test_clothes_become_skin(self):
        """Below the chin some of the clothes are face, of about the face's color."""
        own = clothed_person()
        found = bare_shouldered(own, np.random.default_rng(0))
        new = found.labels[..., 0] - own.labels[..., 0] > 0.9
        assert new.sum() > 50
        skin = np.median(own.pixels[own.labels[..., 0] > 0.8], axis=0)
        assert np.abs(np.median(found.pixels[new], axis=0) - skin).max() < 0.25

    def test_without_a_face(self):
        """Where no face is seen nothing changes."""
        own = clothed_person()
        own.labels[...] = 0
        assert bare_shouldered(own, np.random.default_rng(0)) is own


class TestReshaped:
    def test_the_face_stays(self):
        """What stands beside the head moves, the middle of the face does not."""
        own = drawn_person()
        found = reshaped(own, np.random.default_rng(1))
        x, y = own.landmarks.points[:, :2].mean(axis=0).round().astype(int)
        near = (slice(y - 5, y + 6), slice(x - 5, x + 6))
        np.testing.assert_array_equal(found.pixels[near], own.pixels[near])
        assert np.abs(found.labels - own.labels).max() > 0.5
