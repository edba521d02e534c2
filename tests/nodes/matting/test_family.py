"""What every method of matting promises."""

from __future__ import annotations

import cv2
import numpy as np
import pytest
from portraits import landmarks_at, portrait

from graphface import GraphfaceWarning, load
from graphface.nodes.matting.closed_form import closed_form
from graphface.nodes.matting.guided import guided
from graphface.nodes.matting.knn import knn
from graphface.nodes.matting.none import none
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
        """On a picture with clear colors the most likely labels are the true ones nearly everywhere."""
        assert (stacked(matting(*head[:3])).argmax(axis=0) == head[3]).mean() > 0.985

    def test_node(self, matting, head):
        """It keeps an operator's promises."""
        check_node(matting, *head[:3])

    @pytest.mark.parametrize("color", [0.0, 0.5, 1.0, np.nan])
    def test_flat_color(self, matting, color, head):
        """On a picture of one color, or of NaN, alphas are a partition."""
        flat = Image(np.full((160, 160, 3), color, np.float32))
        alphas = stacked(matting(flat, *head[1:3]))
        np.testing.assert_allclose(alphas.sum(axis=0), 1, atol=1e-5)
        assert alphas.min() >= 0

    @pytest.mark.parametrize("label", [0, 1, 2])
    def test_one_label_everywhere(self, matting, label, head):
        """Without a border the labels are unchanged."""
        full = Segmentation(*(np.full((160, 160), float(k == label), np.float32) for k in range(3)))
        np.testing.assert_allclose(stacked(matting(head[0], full, head[2])), stacked(full), atol=1e-5)

    @pytest.mark.parametrize("shape", [(1, 1), (2, 7), (5, 5)])
    def test_tiny_pictures(self, matting, shape, rng):
        """Pictures smaller than a window give a partition, too."""
        photo = Image(rng.uniform(0, 1, (*shape, 3)).astype(np.float32))
        labels = soft(rng.integers(0, 3, shape), 0.5)
        alphas = stacked(matting(photo, labels, landmarks_at(2, 2, 3)))
        np.testing.assert_allclose(alphas.sum(axis=0), 1, atol=1e-5)

    def test_swappable(self, matting, head):
        """Each can replace each other in a graph."""
        registry = default_registry()
        names = {o.name for o in registry.alternatives(registry.operator("matting.guided"))}
        assert names == {"matting.none", "matting.closed_form", "matting.knn"}


@pytest.mark.parametrize("matting", [guided, closed_form])
def test_follows_the_photo(matting):
    """A border that is two pixels off moves to the edge of the colors."""
    pixels = np.zeros((60, 60, 3), np.float32)
    pixels[:, 30:] = (0.9, 0.7, 0.5)
    labels = np.where(np.arange(60) < 32, 2, 0) * np.ones((60, 1), int)
    found = matting(Image(pixels), soft(labels), landmarks_at(30, 30, 60))
    assert (found.face[5:-5, 31] > 0.5).all()
    assert (found.face[5:-5, 28] < 0.5).all()


@pytest.mark.parametrize("operator", ["matting.closed_form", "matting.knn"])
@pytest.mark.parametrize(("old", "new"), [("trust", "label_weight"), ("strands", "hair_width")])
def test_former_names(operator, old, new):
    """Parameters keep their former names in graphs, with a warning."""
    with pytest.warns(GraphfaceWarning, match=new):
        graph = load("segment", replace={"matted": operator}, set={f"matted.{old}": 0.01})
    assert next(step for step in graph.steps if step.name == "matted").parameters[new] == 0.01
