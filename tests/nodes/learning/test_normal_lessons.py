"""What the normals network sees of rendered examples."""

from __future__ import annotations

import numpy as np
import pytest

from graphface import UnreadableFile
from graphface.nodes.bench.heads import heads_of
from graphface.nodes.landmarks.facemesh import facemesh
from graphface.nodes.learning.normal_lessons import lessons_of, shadow_of
from graphface.nodes.learning.rendering.example import FORMAT, Example, write_example
from graphface.nodes.surface.face_crop import SIZE, face_crop


def example_of(head, kind="hard"):
    """A path-traced head of the shared truth as an example; its left half is called shadow."""
    photo = np.round(head.photo("frontal").pixels * 255).astype(np.uint8)
    labels = (head.face > 0.5).astype(np.uint8)
    normals = np.round(head.normals * 127 * labels[..., None]).astype(np.int8)
    visibility = np.where(np.arange(labels.shape[1]) < labels.shape[1] // 2, 0, 255 * labels).astype(np.uint8)
    lights = {"kind": kind, "lamps": [{"direction": (0.0, 0.0, 1.0)}]}
    return Example(photo, normals, labels.astype(np.float16), labels, visibility, {"format": FORMAT, "lights": lights})


class TestLessonsOf:
    def test_nothing_to_learn_from(self, tmp_path):
        """A folder without examples is refused by name."""
        with pytest.raises(UnreadableFile, match="no examples"):
            list(lessons_of(tmp_path))

    def test_kept(self, shared, tmp_path):
        """A lesson is computed once; its normals are unit vectors where they count, and near the fitted ones."""
        write_example(example_of(next(iter(heads_of(shared)))), tmp_path / "0.npz")
        (first,) = lessons_of(tmp_path)
        (kept,) = tmp_path.glob("seen/*/0.npz")
        before = kept.stat().st_mtime_ns
        (again,) = lessons_of(tmp_path)
        assert kept.stat().st_mtime_ns == before
        np.testing.assert_array_equal(first.seen, again.seen)
        on = first.weight > 0.5
        assert on.mean() > 0.2
        fitted, true = first.seen[on][:, 3:6].astype(float), first.normals[on].astype(float)
        np.testing.assert_allclose(np.linalg.norm(true, axis=1), 1, atol=0.01)
        assert np.degrees(np.arccos(np.clip((fitted * true).sum(axis=1), -1, 1))).mean() < 20


class TestShadowOf:
    def test_faces_the_lamp(self, shared):
        """Half of the face is in shadow; what is turned away from the lamp counts less than what faces it."""
        head = next(iter(heads_of(shared)))
        crop = face_crop(facemesh(head.photo("frontal")))
        shadow, lit = shadow_of(example_of(head), crop)
        middle = slice(SIZE // 2 - 10, SIZE // 2 + 10)
        assert shadow[middle, 30].mean() > 0.95
        assert shadow[middle, -31].mean() < 0.05
        assert lit[middle, SIZE // 2].mean() > 1.2 * lit[middle, 24].mean() > 0

    def test_even_light(self, shared):
        """Even light has no shadow, and all skin counts."""
        head = next(iter(heads_of(shared)))
        shadow, lit = shadow_of(example_of(head, "even"), face_crop(facemesh(head.photo("frontal"))))
        assert not shadow.any()
        assert lit.mean() > 0.3
