"""Hard landmarks: the fit's answer is finite and bounded, or a clear error; and it does not depend on the start."""

from __future__ import annotations

import warnings
from dataclasses import replace

import numpy as np
import pytest
from faces import coefficients_of, grid_model, landmarks_of, rotation_of
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from graphface import GraphfaceWarning
from graphface.nodes.geometry.average import average
from graphface.nodes.geometry.facemesh import facemesh
from graphface.nodes.geometry.morphable import morphable
from graphface.nodes.landmark_schemes import UnusableLandmarks
from graphface.nodes.morphable.builtin import builtin_model
from graphface.nodes.morphable.fit import fit
from graphface.nodes.morphable.fit_problem import Settings
from graphface.nodes.morphable.model import no_basis
from graphface.nodes.morphable.pose import Pose, closed_form
from graphface.nodes.morphable.prior import Mixture, prepare, quadratic
from graphface.nodes.morphable.solve import Problem, View, solve
from graphface.nodes.types import Landmarks

BOUND = 60.0
"""No coefficient may leave the prior further than this, in standard deviations."""


def quietly(build, *arguments, **settings_):
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", GraphfaceWarning)
        return build(*arguments, **settings_)


def is_sound(mesh, size=1e5):
    """Finite, bounded, with unit normals and a proper rotation."""
    assert np.isfinite(mesh.vertices).all()
    assert np.abs(mesh.vertices).max() < size
    np.testing.assert_allclose(np.linalg.norm(mesh.normals, axis=1), 1, atol=1e-4)
    assert np.linalg.det(mesh.fit.rotation) == pytest.approx(1, abs=1e-6)
    assert max(np.abs(mesh.fit.identity).max(), np.abs(mesh.fit.expression).max(initial=0)) < BOUND
    assert np.isfinite([mesh.fit.residual, mesh.fit.condition, mesh.fit.scale, mesh.interocular]).all()


def points68(points):
    full = np.zeros((68, 3), np.float32)
    full[:, : points.shape[1]] = points
    return Landmarks(full, "ibug68")


class TestHardLandmarks:
    @given(arrays(np.float32, (68, 2), elements=st.floats(-1e4, 1e4, width=32)))
    @settings(max_examples=25, deadline=None)
    def test_any_numbers(self, points):
        """Whatever the points: a sound mesh, or UnusableLandmarks."""
        for camera in ("weak", "estimated"):
            try:
                mesh = quietly(morphable, points68(points), camera=camera)
            except UnusableLandmarks:
                continue
            is_sound(mesh, 1e8)

    @given(st.floats(0, 180), st.floats(10, 1000))
    @settings(max_examples=15, deadline=None)
    def test_collinear(self, angle, length):
        """Points on one line give a sound mesh."""
        direction = np.array([np.cos(np.radians(angle)), np.sin(np.radians(angle))])
        is_sound(quietly(morphable, points68(np.linspace(-1, 1, 68)[:, None] * length * direction)))

    def test_collinear_is_said(self):
        """The guess is announced."""
        with pytest.warns(GraphfaceWarning, match="one line"):
            morphable(points68(np.linspace(0, 300, 68)[:, None] * [1, 0.5]))

    def test_coincident(self):
        """All in one place is a clear error, whatever the method."""
        for build in (morphable, average):
            with pytest.raises(UnusableLandmarks, match="one place"):
                build(points68(np.full((68, 2), 7.0)))

    @given(st.sets(st.integers(0, 467), max_size=450))
    @settings(max_examples=15, deadline=None)
    def test_missing(self, missing):
        """Any points may be missing, down to a handful."""
        landmarks = landmarks_of(coefficients=coefficients_of(1), rotation=rotation_of(15))
        points = landmarks.points.copy()
        points[sorted(missing), :2] = np.nan
        is_sound(quietly(morphable, Landmarks(points, "facemesh468")))

    def test_infinite(self):
        """Infinite points are missing points."""
        points = landmarks_of().points.copy()
        points[:10, 0] = np.inf
        is_sound(quietly(morphable, Landmarks(points, "facemesh468")))

    def test_too_few(self):
        """Five points are a clear error that says how many are needed."""
        points = np.full((468, 3), np.nan, np.float32)
        points[:5] = landmarks_of().points[:5]
        with pytest.raises(UnusableLandmarks, match="at least 6"):
            quietly(morphable, Landmarks(points, "facemesh468"))

    @given(st.integers(17, 67), st.floats(-5000, 5000), st.floats(-5000, 5000))
    @settings(max_examples=20, deadline=None)
    def test_one_outlier_of_68(self, point, x, y):
        """One of the 68 points anywhere in the picture moves no vertex far."""
        landmarks = landmarks_of(coefficients=coefficients_of(2, 0.4), scheme="ibug68")
        spoiled = landmarks.points.copy()
        spoiled[point, :2] = (x, y)
        clean = quietly(morphable, landmarks)
        robust = quietly(morphable, Landmarks(spoiled, "ibug68"))
        apart = np.linalg.norm(clean.camera.project(clean.vertices) - robust.camera.project(robust.vertices), axis=1)
        assert np.median(apart) < 0.06 * 150

    def test_mirrored(self):
        """Points in a mirror give a sound mesh, and a warning that they look turned away."""
        points = landmarks_of(coefficients=coefficients_of(3), rotation=rotation_of(20)).points * np.float32([-1, 1, 1])
        with pytest.warns(GraphfaceWarning, match="mirrored"):
            mesh = morphable(Landmarks(points, "facemesh468"))
        is_sound(mesh)

    @pytest.mark.parametrize("size", [1e-2, 1.0, 1e4])
    def test_any_resolution(self, size):
        """The face of one pixel and the face of a poster have the same shape."""
        coefficients = coefficients_of(4)
        small = quietly(morphable, landmarks_of(coefficients=coefficients, scale=size, center=(0, 0)))
        usual = quietly(morphable, landmarks_of(coefficients=coefficients, scale=150, center=(0, 0)))
        np.testing.assert_allclose(small.vertices / size, usual.vertices / 150, atol=0.01)

    @pytest.mark.parametrize("yaw", [-85, -60, 60, 85, 120, 180])
    def test_profiles_and_beyond(self, yaw):
        """Even a face seen from behind is answered."""
        is_sound(quietly(morphable, landmarks_of(coefficients=coefficients_of(5), rotation=rotation_of(yaw))))

    @given(st.floats(-44, 44), st.floats(-20, 20))
    @settings(max_examples=15, deadline=None)
    def test_a_small_turn_is_a_small_change(self, yaw, pitch):
        """Half a degree more moves no landmark vertex by more than a few pixels: no jump between correspondences."""
        one, two = (
            quietly(
                morphable,
                landmarks_of(coefficients=coefficients_of(6), rotation=rotation_of(y, pitch), scheme="ibug68"),
            )
            for y in (yaw, yaw + 0.5)
        )
        assert np.abs(one.vertices - two.vertices).max() < 0.08 * 150


class TestStarts:
    def test_fifty_random_starts(self):
        """From any pose, the same face within a hundredth of a pixel."""
        landmarks = landmarks_of(coefficients=coefficients_of(7), rotation=rotation_of(20, 5))
        rng = np.random.default_rng(0)
        settings_ = Settings(tolerance=1e-9, steps=60)
        usual = quietly(fit, builtin_model(), landmarks, settings_)
        for _ in range(50):
            start = Pose(rotation_of(*rng.uniform(-180, 180, 3)), rng.uniform(5, 900), rng.uniform(-500, 500, 2))
            mesh = quietly(fit, builtin_model(), landmarks, settings_, start=start)
            np.testing.assert_allclose(mesh.vertices, usual.vertices, atol=0.01)

    def test_fifty_random_searches(self):
        """The search itself, from poses up to 40 degrees off and random coefficients, ends at one answer."""
        model, landmarks = builtin_model(), landmarks_of(coefficients=coefficients_of(9, 0.5), rotation=rotation_of(10))
        points = (landmarks.points[:, :2] - (320, 240)) * (1, -1)
        rows = model.landmarks["facemesh468"]
        problem = Problem(
            mean=model.mean[rows].astype(float),
            directions=model.directions[:, rows].astype(float),
            points=points.astype(float),
            weights=np.full(468, 68 / 468),
            prior=prepare(model.prior),
            noise=0.03,
            robust=0.3,
            strength=1.0,
            nearness=(0.0, 0.0),
            pixel=150.0,
        )
        rng, found = np.random.default_rng(0), []
        for _ in range(50):
            turn = rotation_of(*rng.uniform(-40, 40, 3))
            view = View(turn, 150 * rng.uniform(0.7, 1.4), rng.uniform(-50, 50, 2), 0.0, rng.normal(scale=0.5, size=25))
            found.append(solve([problem], [view], steps=200, tolerance=1e-12).views[0].x)
        assert np.ptp(found, axis=0).max() < 0.05

    def test_half_a_turn_off(self):
        """A start that looks the other way is not believed."""
        landmarks = landmarks_of(coefficients=coefficients_of(8))
        start = Pose(rotation_of(180), 150.0, np.zeros(2))
        mesh = quietly(fit, builtin_model(), landmarks, Settings(), start=start)
        assert mesh.fit.rotation[2, 2] > 0.9

    def test_a_start_that_is_no_pose(self):
        """A start of NaN is not used."""
        start = Pose(np.full((3, 3), np.nan), np.nan, np.full(2, np.nan))
        is_sound(quietly(fit, builtin_model(), landmarks_of(), Settings(), start=start))


class TestHardModels:
    def test_no_expressions(self):
        """A model without expressions is fitted by identity alone."""
        model = builtin_model()
        bare = replace(model, expression=no_basis(len(model.mean)), prior=None)
        is_sound(quietly(morphable, landmarks_of(coefficients=coefficients_of(1)), model=bare))

    def test_nothing_to_vary(self):
        """A rigid model is the average face."""
        none = no_basis(144)
        mesh = quietly(
            morphable, landmarks_of(grid_model(), scheme="ibug68"), model=grid_model(identity=none, expression=none)
        )
        assert np.isfinite(mesh.vertices).all()

    def test_more_components_than_numbers(self):
        """25 coefficients from 8 points: the prior decides what the points do not."""
        points = np.full((468, 3), np.nan, np.float32)
        chosen = [4, 33, 263, 61, 291, 152, 10, 168]
        points[chosen] = landmarks_of(coefficients=coefficients_of(2)).points[chosen]
        is_sound(quietly(morphable, Landmarks(points, "facemesh468")))

    def test_a_singular_component(self):
        """A prior one of whose components has no spread at all is lifted, with a warning."""
        model = builtin_model()
        size = len(model.identity) + len(model.expression)
        covariances = np.stack([np.eye(size), np.zeros((size, size))]).astype(np.float32)
        singular = Mixture(np.float32([0.5, 0.5]), np.zeros((2, size), np.float32), covariances)
        with pytest.warns(GraphfaceWarning, match="singular"):
            mesh = morphable(landmarks_of(coefficients=coefficients_of(3)), model=replace(model, prior=singular))
        is_sound(mesh)

    @given(
        arrays(np.float64, 3, elements=st.floats(-1e3, 1e3)),
        arrays(np.float64, (3, 3), elements=st.floats(-10, 10)),
        st.floats(0, 1),
    )
    @settings(max_examples=50, deadline=None)
    def test_any_prior(self, x, root, weight):
        """Any covariance of any rank gives a finite value, gradient and bound."""
        mixture = Mixture(
            np.float32([weight, 1]),
            np.zeros((2, 3), np.float32),
            np.stack([root @ root.T, np.eye(3)]).astype(np.float32),
        )
        prior = quietly(prepare, mixture)
        for part in quadratic(prior, x):
            assert np.isfinite(part).all()


class TestClosedForm:
    @given(
        arrays(np.float64, (8, 3), elements=st.floats(-1e3, 1e3)),
        arrays(np.float64, (8, 2), elements=st.floats(-1e5, 1e5)),
    )
    @settings(max_examples=50, deadline=None)
    def test_is_always_a_rotation(self, shape, points):
        """Any shape and any points, flat and coincident ones too."""
        pose = closed_form(shape, points)
        np.testing.assert_allclose(pose.rotation @ pose.rotation.T, np.eye(3), atol=1e-6)
        assert np.isfinite([pose.scale, *pose.offset]).all()


class TestNeighbours:
    def test_direct_mesh_of_flat_points(self):
        """FaceMesh points without depth have normals that all look at the viewer."""
        normals = facemesh(landmarks_of()).normals
        np.testing.assert_allclose(normals, np.tile(np.float32([0, 0, 1]), (468, 1)), atol=1e-5)
