"""Rendered heads as training pictures of the label network."""

from __future__ import annotations

import numpy as np
import pytest
from portraits import portrait

from graphface import UnreadableFile
from graphface.nodes.face_outlines import LIPS
from graphface.nodes.learning.label_renderings import labels_of, rendered_pictures
from graphface.nodes.learning.rendering.example import BARE_SKIN, FORMAT, REST, Example, write_example


def drawn_example():
    """A drawn head as an example, with an open mouth that is neither skin nor teeth."""
    photo, landmarks, truth = portrait()
    labels = np.where(truth == 0, BARE_SKIN, REST).astype(np.uint8)
    middle = landmarks.points[list(LIPS), :2].mean(axis=0).round().astype(int)
    labels[middle[1] - 1 : middle[1] + 2, middle[0] - 2 : middle[0] + 3] = REST
    depth = (truth != 2).astype(np.float16)
    pixels = np.rint(255 * photo.pixels).clip(0, 255).astype(np.uint8)
    zeros = np.zeros(truth.shape, np.uint8)
    normals = np.zeros((*truth.shape, 3), np.int8)
    return Example(pixels, normals, depth, labels, zeros, {"format": FORMAT}), landmarks, truth


class TestLabelsOf:
    def test_mouth_is_face_and_the_rest_of_the_head_hair(self):
        """Skin and the mouth are face, what else belongs to the head is hair, the wall neither."""
        example, landmarks, truth = drawn_example()
        found = labels_of(example, landmarks)
        np.testing.assert_array_equal(found[..., 0] > 0, truth == 0)
        np.testing.assert_array_equal(found[..., 1] > 0, truth == 1)


class TestRenderedPictures:
    def test_no_examples(self, tmp_path):
        """A folder without examples is refused, with the command that makes them."""
        with pytest.raises(UnreadableFile, match="models render"):
            list(rendered_pictures(tmp_path, 3))

    def test_without_a_face(self, tmp_path):
        """An example in which no face is found is left out."""
        example, _, _ = drawn_example()
        black = Example(np.zeros_like(example.photo), *(getattr(example, name) for name in _OTHERS))
        write_example(black, tmp_path / "0.npz")
        assert list(rendered_pictures(tmp_path, 3)) == []


_OTHERS = ("normals", "depth", "labels", "visibility", "facts")
