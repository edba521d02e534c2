"""From folders of pictures to weights of the label network."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from drawn import PICTURE

from graphface import UnreadableFile
from graphface.nodes.learning.label_learning import Schedule, Sources, examples_of, hairy, learn_labels
from graphface.nodes.learning.label_training import Examples


class TestExamplesOf:
    def test_examples(self):
        """As many variations of a picture as asked for."""
        examples = examples_of([(PICTURE, 3)], [PICTURE], 0)
        assert isinstance(examples, Examples)
        assert len(examples.cells) == len(examples.labels) == len(examples.weight) == 3


class TestHairy:
    def test_hairy(self):
        """Hair below the middle of the face counts, hair on top alone does not."""
        labels = np.zeros_like(PICTURE.labels)
        half = len(labels) // 2
        labels[: half // 2, :, 1] = 255
        assert not hairy(replace(PICTURE, labels=labels))
        labels[:, : labels.shape[1] // 4, 1] = 255
        assert hairy(replace(PICTURE, labels=labels))


class TestLearnLabels:
    def test_nothing_to_learn_from(self, tmp_path: Path):
        """A folder without a face is refused by name."""
        with pytest.raises(UnreadableFile, match="no photograph"):
            learn_labels(Sources(tmp_path), Schedule(steps=1))

    @pytest.mark.filterwarnings("error")
    @pytest.mark.parametrize("chosen", [{"without": ["mk_*"]}, {"only": ["pd_*"]}])
    def test_left_out(self, tmp_path: Path, chosen):
        """Pictures that are left out by name, or are not among those named, are not read."""
        for name in ("mk_1.jpg", "mk_2.png"):
            (tmp_path / name).write_bytes(b"no picture")
        with pytest.raises(UnreadableFile, match="no photograph"):
            learn_labels(Sources(tmp_path, **chosen), Schedule(steps=1))
