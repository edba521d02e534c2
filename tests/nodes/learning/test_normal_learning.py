"""From rendered examples to weights of the normals network."""

from __future__ import annotations

import numpy as np
import pytest

from graphface import UnreadableFile
from graphface.nodes.bench.heads import heads_of
from graphface.nodes.learning.normal_learning import learn_normals
from graphface.nodes.learning.normal_lessons import lessons_of
from graphface.nodes.learning.normal_training import Pictures, trained
from graphface.nodes.learning.rendering.example import FORMAT, Example, write_example
from graphface.nodes.learning.unet_training import folded, trainable
from graphface.nodes.surface.normal_network import CHANNELS, WIDTHS, corrections


def example_of(head):
    """A path-traced head of the shared truth as an example."""
    photo = np.round(head.photo("frontal").pixels * 255).astype(np.uint8)
    labels = (head.face > 0.5).astype(np.uint8)
    normals = np.round(head.normals * 127 * labels[..., None]).astype(np.int8)
    return Example(photo, normals, labels.astype(np.float16), labels, labels, {"format": FORMAT})


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

    def test_no_face_is_left_out(self, tmp_path):
        """An example in which no face is found is left out, and the reason kept."""
        flat = np.full((64, 64), 1, np.uint8)
        photo = np.repeat(flat[..., None], 3, axis=2)
        write_example(Example(photo, photo.astype(np.int8), flat, flat, flat, {"format": FORMAT}), tmp_path / "0.npz")
        with pytest.raises(UnreadableFile, match="no two examples"):
            learn_normals(tmp_path, minutes=0)
        assert "no face" in next(tmp_path.glob("seen/*/0.txt")).read_text()


class TestTrained:
    def test_learns(self, rng):
        """The loss of a few steps is finite, and the NumPy network says what the trained one says."""
        torch = pytest.importorskip("torch", reason="training needs PyTorch: pip install 'graphface[learn]'")
        seen = (rng.normal(size=(13, 128, 128, CHANNELS)) * 0.3).astype(np.float16)
        normals = np.broadcast_to(np.float16([0, 0, 1]), (13, 128, 128, 3)).copy()
        pictures = Pictures(seen, normals, np.ones((13, 128, 128), np.float16))
        state, figures = trained(pictures, minutes=0)
        assert figures["steps"] == 2
        assert np.isfinite(list(figures["degrees_off_kept_back"].values())).all()
        net = trainable(4 * CHANNELS, WIDTHS).eval()
        net.load_state_dict(state)
        cells = torch.nn.functional.pixel_unshuffle(
            torch.from_numpy(seen[:1].astype(np.float32).transpose(0, 3, 1, 2)), 2
        )
        expected = net(cells)[0].detach().numpy().transpose(1, 2, 0)
        weights = {name: values.astype(np.float32) for name, values in folded(state).items()}
        np.testing.assert_allclose(corrections(seen[0].astype(np.float32), weights, False), expected, atol=0.02)
