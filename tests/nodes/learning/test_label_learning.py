"""From folders of pictures to weights of the label network."""

from __future__ import annotations

from pathlib import Path

import pytest
from drawn import PICTURE

from graphface import UnreadableFile
from graphface.nodes.learning.label_learning import Schedule, examples_of, learn_labels
from graphface.nodes.learning.label_training import Examples


class TestExamplesOf:
    def test_examples(self):
        """As many variations of a picture as asked for."""
        examples = examples_of([(PICTURE, 3)], [PICTURE], 0)
        assert isinstance(examples, Examples)
        assert len(examples.cells) == len(examples.labels) == len(examples.weight) == 3


class TestLearnLabels:
    def test_nothing_to_learn_from(self, tmp_path: Path):
        """A folder without a face is refused by name."""
        with pytest.raises(UnreadableFile, match="no photograph"):
            learn_labels(tmp_path, None, None, None, Schedule(steps=1))

    @pytest.mark.filterwarnings("error")
    def test_left_out(self, tmp_path: Path):
        """Pictures that are left out by name are not read."""
        for name in ("mk_1.jpg", "mk_2.png"):
            (tmp_path / name).write_bytes(b"no picture")
        with pytest.raises(UnreadableFile, match="no photograph"):
            learn_labels(tmp_path, None, None, None, Schedule(steps=1), without=["mk_*"])
