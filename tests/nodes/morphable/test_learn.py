"""Learning: a known model comes back from faces made by it."""

from __future__ import annotations

import numpy as np
import pytest
from faces import rotation_of
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from graphface import UsageError
from graphface.nodes.morphable.align import aligned, procrustes_mean
from graphface.nodes.morphable.learn import learn_model
from graphface.nodes.morphable.prior import Mixture, fit_mixture, leading, prepare, quadratic, standard
from graphface.nodes.morphable.topology import facemesh_topology


def faces_of(rng, count, directions, spread=1.0):
    """Faces that vary in the given symmetric directions, posed and scaled at random."""
    mean = facemesh_topology().mean.astype(float)
    made = []
    for _ in range(count):
        shape = mean + np.tensordot(rng.normal(scale=spread, size=len(directions)), directions, axes=1)
        rotation = rotation_of(*rng.uniform(-15, 15, size=3))
        made.append(rng.uniform(50, 300) * shape @ rotation.T + rng.normal(size=3) * 100)
    return np.stack(made)


@pytest.fixture
def directions(rng):
    """Two symmetric directions: longer, and deeper."""
    mean = facemesh_topology().mean.astype(float)
    return np.stack([mean * (0, 0.05, 0), mean * (0, 0, 0.08)])


class TestLearnModel:
    def test_recovers_the_directions(self, rng, directions):
        """Faces that vary in one way, and people that vary in another, give those ways back."""
        portraits = faces_of(rng, 60, directions[:1])
        people = np.concatenate([faces_of(rng, 5, directions[1:]) for _ in range(8)])
        names = [f"p{k // 5}" for k in range(40)]
        model, lesson = learn_model("toy", portraits, people, names, identity=1, expression=1)
        assert lesson.left < 0.5
        assert lesson.people == 8
        ours = model.expression.directions[0].ravel()
        theirs = directions[1] - directions[1].mean(axis=0)
        cosine = ours @ theirs.ravel() / np.linalg.norm(ours) / np.linalg.norm(theirs)
        assert abs(cosine) > 0.9

    def test_the_model_is_symmetric(self, rng, directions):
        """Lopsided faces teach a symmetric mean."""
        portraits = faces_of(rng, 30, directions) + rng.normal(scale=0.5, size=(30, 468, 3))
        model, _ = learn_model("toy", portraits, np.zeros((0, 468, 3)), [], identity=2, expression=0)
        mirrored = model.mean[facemesh_topology().mirror] * (-1, 1, 1)
        np.testing.assert_allclose(mirrored, model.mean, atol=1e-3)

    def test_too_few_faces_is_an_error(self, rng, directions):
        """Components need faces; the message says how many."""
        with pytest.raises(UsageError, match="at least 20"):
            learn_model("toy", faces_of(rng, 8, directions), np.zeros((0, 468, 3)), [], identity=10, expression=0)
        with pytest.raises(UsageError, match="--people"):
            learn_model("toy", faces_of(rng, 8, directions), np.zeros((0, 468, 3)), [], identity=2, expression=2)


class TestAligned:
    @given(st.integers(0, 1000))
    def test_undoes_any_similarity(self, seed):
        """Position, size and turn are taken off exactly; a mirror image is not turned into the face."""
        rng = np.random.default_rng(seed)
        target = rng.normal(size=(9, 3))
        rotation = rotation_of(*rng.uniform(-180, 180, size=3))
        posed = rng.uniform(0.1, 50) * target @ rotation.T + rng.normal(size=3)
        np.testing.assert_allclose(aligned(posed[None], target)[0][0], target, atol=1e-8)
        assert np.linalg.det(aligned(posed[None] * (-1, 1, 1), target)[1][0]) == pytest.approx(1)

    @given(arrays(np.float64, (2, 4, 3), elements=st.floats(-1e6, 1e6)))
    def test_stays_finite(self, shapes):
        """Coincident and collinear shapes give numbers."""
        assert np.isfinite(aligned(shapes, shapes[0])[0]).all()
        assert np.isfinite(procrustes_mean(shapes, shapes[0])).all()


class TestPrior:
    @given(arrays(np.float64, 3, elements=st.floats(-5, 5)))
    def test_the_quadratic_bounds_the_mixture(self, x):
        """The bound touches at x, and lies above everywhere else: descending it descends the prior."""
        rng = np.random.default_rng(1)
        means, roots = rng.normal(size=(3, 3)), rng.normal(size=(3, 3, 3))
        covariances = roots @ roots.transpose(0, 2, 1) + 0.1 * np.eye(3)
        prior = prepare(Mixture(np.float32([0.2, 0.3, 0.5]), means.astype(np.float32), covariances.astype(np.float32)))
        value, gradient, hessian = quadratic(prior, x)
        for step in rng.normal(size=(20, 3)):
            bound = value + gradient @ step + step @ hessian @ step / 2
            assert quadratic(prior, x + step)[0] <= bound + 1e-6 * (1 + abs(bound))

    def test_gradient_is_the_derivative(self, rng):
        """Central differences of the value agree with the gradient."""
        prior = prepare(
            Mixture(np.float32([0.5, 0.5]), np.float32([[-1, 0], [2, 1]]), np.stack([np.eye(2)] * 2).astype(np.float32))
        )
        x = rng.normal(size=2)
        steps = 1e-5 * np.eye(2)
        differences = [(quadratic(prior, x + s)[0] - quadratic(prior, x - s)[0]) / 2e-5 for s in steps]
        np.testing.assert_allclose(differences, quadratic(prior, x)[1], atol=1e-6)

    def test_bic_finds_two_clusters(self, rng):
        """Two clouds far apart are two components or more, one cloud is one."""
        clouds = np.concatenate([rng.normal(size=(150, 2)) - 6, rng.normal(size=(150, 2)) + 6])
        assert len(fit_mixture(clouds).weights) == 2
        assert len(fit_mixture(rng.normal(size=(300, 2))).weights) == 1

    def test_the_marginal_of_some_coefficients(self):
        """Leaving coefficients out keeps the means and covariances of the others."""
        kept = leading(standard(4), np.array([1, 3]))
        assert kept.means.shape == (1, 2)
        np.testing.assert_array_equal(kept.covariances[0], np.eye(2))
