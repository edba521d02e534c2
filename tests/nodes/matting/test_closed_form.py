"""Solving in the band gives the alphas of the whole picture."""

from __future__ import annotations

import cv2
import numpy as np
import pytest
from portraits import portrait
from scipy.sparse.linalg import spsolve

from graphface.nodes.bench.matting_speed import whole_picture
from graphface.nodes.matting.band import band_of, hard_alphas, soft_alphas, with_alphas
from graphface.nodes.matting.closed_form import closed_form
from graphface.nodes.matting.laplacian import band_system
from graphface.nodes.types import Segmentation

BAND = {"width": 0.06, "hair_width": 0.15}


def soft(labels):
    """Labels of 0, 1, 2 as soft masks with a blurred border."""
    parts = [cv2.GaussianBlur((labels == k).astype(np.float32), (0, 0), 1.5) for k in range(3)]
    return Segmentation(*(p / sum(parts) for p in parts))


@pytest.fixture(scope="module")
def head():
    photo, landmarks, labels = portrait(160, noise=0.01)
    return photo, soft(labels), landmarks


class TestClosedForm:
    @pytest.mark.parametrize("label_weight", [1e-4, 1e-6])
    def test_band_gives_the_alphas_of_the_whole(self, head, label_weight):
        """As it is shipped, it differs from PyMatting's whole-picture alphas by less than 0.005 on average."""
        photo, labels, landmarks = head
        band = band_of(labels, landmarks.interocular, **BAND)
        unknown = np.zeros(labels.face.shape, bool)
        unknown[band.part] = band.unknown
        whole = whole_picture(photo, labels, unknown, label_weight)
        found = closed_form(photo, labels, landmarks, **BAND, label_weight=label_weight)
        apart = np.abs(np.stack([found.face, found.hair, found.background], axis=2) - whole)
        assert unknown.mean() > 0.05
        assert apart[unknown].mean(axis=0).max() < 0.005
        certain = np.stack([labels.face, labels.hair, labels.background], axis=2)
        assert np.abs(certain - whole)[unknown].mean(axis=0).max() > 0.01, "the labels alone would do"

    def test_tolerance_goes_to_the_exact_solution(self, head):
        """With a small tolerance the alphas are those of a direct solve, pixel by pixel."""
        photo, labels, landmarks = head
        band = band_of(labels, landmarks.interocular, **BAND)
        guess, known = soft_alphas(labels, band), hard_alphas(labels, band.part)
        colors = photo.pixels[band.part].astype(np.float64)
        system, right = band_system(colors, band.unknown, known, guess, ridge=1e-7, label_weight=1e-4)
        exact = with_alphas(labels, band, spsolve(system.tocsc(), right))
        found = closed_form(photo, labels, landmarks, **BAND, label_weight=1e-4, tolerance=1e-7)
        np.testing.assert_allclose(found.face, exact.face, atol=1e-3)
        np.testing.assert_allclose(found.hair, exact.hair, atol=1e-3)
