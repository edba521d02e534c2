"""Light that falls off over a wall behind the head."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from graphface.nodes.render.wall import placed_lamps, wall
from graphface.nodes.types import Camera, DirectionalLight, Image, Mesh, PointLight, Scene
from graphface.testing import check_node

SIDE = 120
MESH = Mesh(
    np.float32([[-10, 0, 0], [10, 0, 0], [0, -20, 0]]),
    np.int32([[0, 2, 1]]),
    np.float32([[-10, 0, 0], [10, 0, 0], [0, -20, 0]]),
    Camera(scale=1.0, center=(60.0, 40.0)),
    20.0,
)
PHOTO = Image(np.full((SIDE, SIDE, 3), 0.5, np.float32), encoding="srgb")
OLD = np.full((SIDE, SIDE), 0.5, np.float32)
NEW = np.full((SIDE, SIDE), 0.8, np.float32)


def candle(**more):
    return Scene(lights=(PointLight(position=(-2.0, 0.0, 2.0)),), **more)


class TestWall:
    def test_falls_off_with_the_distance(self):
        """The wall is darker than the head's rim, most on the side away from the lamp; never negative."""
        lit = wall(OLD, NEW, candle(), MESH, PHOTO)
        assert lit.max() < NEW.max()
        top = lit[5]
        assert top[10] > top[60] > top[110] > 0

    def test_a_lamp_that_is_far(self):
        """From far away all is as near."""
        far = Scene(lights=(PointLight(position=(0.0, 0.0, 3000.0)),))
        np.testing.assert_allclose(wall(OLD, NEW, far, MESH, PHOTO), NEW, rtol=0.01)

    def test_the_body_is_near(self):
        """Below the head clothes are lit nearly as the head is, the wall beside it is not."""
        lit = wall(OLD, NEW, candle(), MESH, PHOTO)
        assert lit[110, 60] > 1.2 * lit[5, 60]

    def test_no_lamp_with_a_place(self):
        """A window or the sky light a wall as before: the very array."""
        assert wall(OLD, NEW, Scene(ambient=0.3, lights=(DirectionalLight(),)), MESH, PHOTO) is NEW
        assert wall(OLD, NEW, Scene(lights=(PointLight(intensity=0),)), MESH, PHOTO) is NEW

    def test_light_from_everywhere_stays(self):
        """The more ambient light, the less the lamp's distance matters."""
        means = [wall(OLD, NEW, candle(ambient=a), MESH, PHOTO).mean() for a in (0.0, 0.5, 5.0, 500.0)]
        assert means == sorted(means)
        assert means[-1] == pytest.approx(0.8, abs=0.01)

    def test_what_is_kept_of_the_old_light(self):
        """In mode `add` only the added light falls off; a mixture loses its share."""
        added = wall(OLD, NEW, candle(mode="add"), MESH, PHOTO)
        assert (added > OLD).all()
        assert (added < NEW).all()
        nothing_added = wall(OLD, OLD, candle(mode="add"), MESH, PHOTO)
        np.testing.assert_allclose(nothing_added, OLD, atol=1e-6)

    def test_linear_values_lose_more(self):
        """The same light is a smaller factor of linear values than of encoded ones."""
        linear = Image(PHOTO.pixels, encoding="linear")
        assert wall(OLD, NEW, candle(), MESH, linear).mean() < wall(OLD, NEW, candle(), MESH, PHOTO).mean()

    def test_continuous_in_the_distance(self):
        """A wall that moves back darkens in even steps."""
        means = [wall(OLD, NEW, candle(), MESH, PHOTO, distance=d).mean() for d in np.linspace(0, 10, 21)]
        assert means == sorted(means, reverse=True)
        assert np.abs(np.diff(means)).max() < 0.08

    def test_colored_lamps(self):
        """Each lamp's color falls off by itself."""
        lamps = (
            PointLight(position=(-3.0, 0.0, 1.0), color=(1, 0, 0)),
            PointLight(position=(3.0, 0.0, 1.0), color=(0, 0, 1)),
        )
        lit = wall(OLD, np.repeat(NEW[..., None], 3, axis=2), Scene(lights=lamps), MESH, PHOTO)
        assert lit.shape == (SIDE, SIDE, 3)
        assert lit[5, 5, 0] > lit[5, 115, 0]
        assert lit[5, 5, 2] < lit[5, 115, 2]

    @settings(deadline=None, max_examples=30)
    @given(st.tuples(*[st.floats(-50, 50)] * 3), st.floats(0, 8), st.integers(1, 9), st.integers(1, 9))
    def test_any_lamp(self, place, falloff, height, width):
        """Inside the head, behind the wall, beside the frame: finite, and at most four times as bright."""
        scene = Scene(lights=(PointLight(position=place, falloff=falloff),))
        lit = wall(OLD[:height, :width], NEW[:height, :width], scene, MESH, PHOTO)
        assert np.isfinite(lit).all()
        assert 0 <= lit.min() <= lit.max() <= 4 * 0.8

    def test_is_a_node(self):
        """It is pure and deterministic, and survives what its ports may carry."""
        check_node(wall, OLD, NEW, candle(), MESH, PHOTO)


def test_placed_lamps():
    """Lamps that give light and have a place."""
    lamps = (DirectionalLight(), PointLight(), PointLight(intensity=0))
    assert placed_lamps(Scene(lights=lamps)) == [lamps[1]]
