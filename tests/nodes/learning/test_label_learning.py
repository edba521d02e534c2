"""How the label network is taught."""

from __future__ import annotations

import builtins
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from portraits import portrait

from graphface import UnreadableFile, UsageError
from graphface.nodes.learning.label_learning import Course, examples_of, learn_labels
from graphface.nodes.learning.label_lessons import lesson, plate_behind
from graphface.nodes.learning.label_training import Examples, folded, network, trained
from graphface.nodes.learning.label_variations import example
from graphface.nodes.masks.label_network import label_scores
from graphface.nodes.masks.network_input import CHANNELS
from graphface.nodes.masks.upright_grid import HEIGHT, WIDTH


def drawn_lesson():
    photo, landmarks, labels = portrait()
    masks = np.stack([labels == 0, labels == 1], axis=2).astype(np.float32)
    return lesson("drawn", photo, landmarks, masks, masks.sum(axis=2))


LESSON = drawn_lesson()


class TestLesson:
    def test_upright_with_room(self):
        """The face's middle lies in the same place of every lesson, its labels with it."""
        side = LESSON.labels.shape
        assert LESSON.labels[side[0] // 2, side[1] // 2, 0] == 255
        assert LESSON.pixels.shape[:2] == LESSON.seen.shape == LESSON.person.shape

    def test_room_is_not_seen(self):
        """What the lesson has beyond the photo's frame is marked."""
        assert LESSON.seen[0, 0] == 0
        assert LESSON.seen.max() == 255


class TestPlateBehind:
    @given(st.integers(0, 20))
    @settings(max_examples=10, deadline=None)
    def test_of_one_colour(self, seed):
        """A backdrop of one colour goes on behind the person in that colour."""
        random = np.random.default_rng(seed)
        person = np.zeros((64, 48), np.float32)
        person[20:40, 16:32] = 1
        pixels = np.full((64, 48, 3), 0.3, np.float32)
        pixels[person > 0] = random.uniform(0, 1, 3)
        np.testing.assert_allclose(plate_behind(pixels, person, np.ones_like(person)), 0.3, atol=0.03)

    def test_no_backdrop(self):
        """Where nothing but the person shows the plate is grey."""
        ones = np.ones((40, 40), np.float32)
        np.testing.assert_allclose(plate_behind(np.zeros((40, 40, 3), np.float32), ones, ones), 0.5)


class TestExample:
    @given(st.integers(0, 10_000))
    @settings(max_examples=25, deadline=None)
    @pytest.mark.filterwarnings("ignore::graphface.GraphfaceWarning")
    def test_any_variation(self, seed):
        """Finite, of the network's shapes, labels that sum to 1, weights within 0 and 1."""
        made = example(LESSON, [LESSON], np.random.default_rng(seed))
        assert made.cells.shape == (HEIGHT // 2, WIDTH // 2, CHANNELS)
        assert np.isfinite(made.cells).all()
        np.testing.assert_allclose(made.labels.sum(axis=2), 1, atol=1e-4)
        assert made.weight.min() >= 0
        assert made.weight.max() <= 1

    def test_the_same_again(self):
        """The same seed, the same variation."""
        one, other = (example(LESSON, [LESSON], np.random.default_rng(5)) for _ in range(2))
        np.testing.assert_array_equal(one.cells, other.cells)

    def test_labels_stay_with_the_face(self):
        """Whatever was varied, the middle of the face is face."""
        for seed in range(5):
            made = example(LESSON, [LESSON], np.random.default_rng(seed))
            assert made.labels[HEIGHT // 2, WIDTH // 2, 0] > 0.9


class TestTrained:
    def test_needs_torch(self, monkeypatch):
        """Where PyTorch is missing it is said what to install."""

        def without(name, *rest, **more):
            if name == "torch":
                raise ImportError(name)
            return imported(name, *rest, **more)

        imported = builtins.__import__
        monkeypatch.setattr(builtins, "__import__", without)
        with pytest.raises(UsageError, match="pip install torch"):
            trained(examples_of([(LESSON, 1)], [LESSON], 0), steps=1)

    def test_learns(self):
        """The weights that training gives are those that NumPy computes with, and a few steps lower the loss."""
        torch = pytest.importorskip("torch", reason="training needs PyTorch")
        examples = examples_of([(LESSON, 16)], [LESSON], 0)
        state = trained(examples, steps=20)
        net = network()
        net.load_state_dict(state)
        cells = examples.cells[:1].astype(np.float32)
        expected = net.eval()(torch.from_numpy(cells))[0].detach().numpy().transpose(1, 2, 0)
        weights = {name: values.astype(np.float32) for name, values in folded(state).items()}
        np.testing.assert_allclose(label_scores(cells[0].transpose(1, 2, 0), weights), expected, atol=0.02)

    def test_examples(self):
        """As many variations of a lesson as the course says."""
        examples = examples_of([(LESSON, 3)], [LESSON], 0)
        assert isinstance(examples, Examples)
        assert len(examples.cells) == len(examples.labels) == len(examples.weight) == 3


class TestLearnLabels:
    def test_nothing_to_learn_from(self, tmp_path: Path):
        """A folder without a face is named."""
        with pytest.raises(UnreadableFile, match="no photograph"):
            learn_labels(tmp_path, None, None, None, Course(steps=1))

    @pytest.mark.filterwarnings("error")
    def test_kept_out(self, tmp_path: Path):
        """What is kept out by name is not even looked at."""
        for name in ("mk_1.jpg", "mk_2.png"):
            (tmp_path / name).write_bytes(b"no picture")
        with pytest.raises(UnreadableFile, match="no photograph"):
            learn_labels(tmp_path, None, None, None, Course(steps=1), without=["mk_*"])
