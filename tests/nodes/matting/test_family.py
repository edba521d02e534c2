"""What every choice of matting promises."""

from __future__ import annotations

import sys

import cv2
import numpy as np
import pytest
from portraits import landmarks_at, portrait

from graphface import GraphfaceWarning
from graphface.nodes.matting.band import band_of, likeliest_alphas
from graphface.nodes.matting.closed_form import band_system, closed_form
from graphface.nodes.matting.guided import guided
from graphface.nodes.matting.knn import knn
from graphface.nodes.matting.none import none
from graphface.nodes.matting.solve import solve_alphas
from graphface.nodes.types import Image, Segmentation
from graphface.registry import default_registry
from graphface.testing import check_node

FAMILY = [none, guided, closed_form, knn]


def soft(labels, blur=1.5):
    """Labels of 0, 1, 2 as soft masks with a blurred border."""
    parts = [cv2.GaussianBlur((labels == k).astype(np.float32), (0, 0), blur) for k in range(3)]
    total = sum(parts)
    return Segmentation(*(p / total for p in parts))


def stacked(labels):
    return np.stack([labels.face, labels.hair, labels.background])


@pytest.fixture(scope="module")
def head():
    photo, landmarks, labels = portrait(160, noise=0.01)
    return photo, soft(labels), landmarks, labels


@pytest.mark.parametrize("matting", FAMILY)
class TestFamily:
    def test_partition(self, matting, head):
        """Alphas lie in [0, 1] and sum to 1."""
        alphas = stacked(matting(*head[:3]))
        np.testing.assert_allclose(alphas.sum(axis=0), 1, atol=1e-5)
        assert alphas.min() >= 0
        assert alphas.max() <= 1

    def test_labels_stay(self, matting, head):
        """On a picture with clear colours the likeliest labels are the true ones nearly everywhere."""
        assert (stacked(matting(*head[:3])).argmax(axis=0) == head[3]).mean() > 0.985

    def test_node(self, matting, head):
        """It keeps an operator's promises."""
        check_node(matting, *head[:3])

    @pytest.mark.parametrize("color", [0.0, 0.5, 1.0, np.nan])
    def test_flat_colour(self, matting, color, head):
        """A picture of one colour, or of none, tells nothing: alphas still are a partition."""
        flat = Image(np.full((160, 160, 3), color, np.float32))
        alphas = stacked(matting(flat, *head[1:3]))
        np.testing.assert_allclose(alphas.sum(axis=0), 1, atol=1e-5)
        assert alphas.min() >= 0

    @pytest.mark.parametrize("label", [0, 1, 2])
    def test_one_label_everywhere(self, matting, label, head):
        """Without a border there is nothing to do."""
        full = Segmentation(*(np.full((160, 160), float(k == label), np.float32) for k in range(3)))
        np.testing.assert_allclose(stacked(matting(head[0], full, head[2])), stacked(full), atol=1e-5)

    @pytest.mark.parametrize("shape", [(1, 1), (2, 7), (5, 5)])
    def test_tiny_pictures(self, matting, shape, rng):
        """Pictures smaller than any window are answered too."""
        photo = Image(rng.uniform(0, 1, (*shape, 3)).astype(np.float32))
        labels = soft(rng.integers(0, 3, shape), 0.5)
        alphas = stacked(matting(photo, labels, landmarks_at(2, 2, 3)))
        np.testing.assert_allclose(alphas.sum(axis=0), 1, atol=1e-5)

    def test_swappable(self, matting, head):
        """Each can stand in for each other in a graph."""
        registry = default_registry()
        names = {o.name for o in registry.alternatives(registry.operator("matting.guided"))}
        assert names == {"matting.none", "matting.closed_form", "matting.knn"}


@pytest.mark.parametrize("matting", [guided, closed_form])
def test_follows_the_photo(matting):
    """A border drawn two pixels off moves to where the colours change."""
    pixels = np.zeros((60, 60, 3), np.float32)
    pixels[:, 30:] = (0.9, 0.7, 0.5)
    labels = np.where(np.arange(60) < 32, 2, 0) * np.ones((60, 1), int)
    found = matting(Image(pixels), soft(labels), landmarks_at(30, 30, 60))
    assert (found.face[5:-5, 31] > 0.5).all()
    assert (found.face[5:-5, 28] < 0.5).all()


class TestClosedForm:
    def test_band_gives_the_alphas_of_the_whole(self, head):
        """Solving in the band alone gives the whole picture's alphas, mean absolute difference below 0.005."""
        from pymatting.laplacian.cf_laplacian import cf_laplacian
        from scipy.sparse import diags
        from scipy.sparse.linalg import spsolve

        photo, labels, landmarks, _ = head
        settings = {"width": 0.06, "strands": 0.15}
        inner = closed_form(photo, labels, landmarks, **settings, trust=1e-9, tolerance=1e-6)
        band = band_of(labels, landmarks.interocular, **settings)
        known = np.ones(labels.face.shape, bool)
        known[band.part] = ~band.unknown
        fixed = likeliest_alphas(labels, np.s_[:, :]).reshape(-1, 2).astype(np.float64)
        whole = cf_laplacian(photo.pixels.astype(np.float64)) + diags(100.0 * known.reshape(-1))
        for k, mine in enumerate((inner.face, inner.hair)):
            alpha = np.clip(spsolve(whole.tocsc(), 100.0 * known.reshape(-1) * fixed[:, k]), 0, 1)
            assert np.abs(alpha.reshape(known.shape) - mine).mean() < 0.005

    def test_starts_at_half_the_size(self, head, monkeypatch):
        """A start from the small picture changes what the solve costs, not what it finds."""
        module = sys.modules[closed_form.__module__]
        plain = stacked(closed_form(*head[:3], tolerance=1e-6))
        monkeypatch.setattr(module, "DIRECT", 200)
        np.testing.assert_allclose(stacked(closed_form(*head[:3], tolerance=1e-6)), plain, atol=2e-3)

    def test_system_is_symmetric_with_known_sums(self, head):
        """A is symmetric, and constants are in the null space: rows of A sum to what the known pixels take."""
        photo, labels, landmarks, _ = head
        band = band_of(labels, landmarks.interocular, width=0.06, strands=0.15)
        known = np.ones((*band.unknown.shape, 2), np.float32)
        matrix, right = band_system(photo.pixels[band.part].astype(np.float64), band, known, 1e-7)
        assert abs(matrix - matrix.T).max() < 1e-9
        np.testing.assert_allclose(np.asarray(matrix.sum(axis=1))[:, 0], right[:, 0], atol=1e-8)


class TestSolveAlphas:
    def test_failed_factors_are_a_warning(self, monkeypatch, rng):
        """Where incomplete Cholesky fails the diagonal serves, and it is said."""
        import pymatting.preconditioner.ichol
        from scipy.sparse import csr_matrix

        def fail(*_args, **_options):
            raise ValueError("insufficient positive-definiteness")

        monkeypatch.setattr(sys.modules[pymatting.preconditioner.ichol.__module__], "ichol", fail)
        half = rng.normal(size=(8, 8))
        matrix, wanted = half @ half.T, rng.uniform(0.2, 0.8, (8, 2))
        with pytest.warns(GraphfaceWarning, match="incomplete Cholesky"):
            found = solve_alphas(csr_matrix(matrix), matrix @ wanted, np.zeros((8, 2)), trust=1e-9, tolerance=1e-9)
        np.testing.assert_allclose(found, wanted, atol=1e-3)

    def test_empty_matrix_keeps_the_guess(self):
        """A system that says nothing leaves the labels as they were."""
        from scipy.sparse import csr_matrix

        guess = np.float32([[0.25, 0.5], [0.0, 1.0]])
        found = solve_alphas(csr_matrix((2, 2)), np.zeros((2, 2)), guess, trust=1e-3, tolerance=1e-4)
        np.testing.assert_allclose(found, guess, atol=1e-6)
