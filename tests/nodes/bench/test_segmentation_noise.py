"""How far labels jump under noise, measured on a drawn head."""

from __future__ import annotations

import numpy as np
import pytest
from portraits import portrait

from graphface import GraphfaceWarning
from graphface.nodes.bench import segmentation_noise
from graphface.nodes.bench.segmentation_graphs import segmentation_graph
from graphface.nodes.bench.segmentation_noise import LEAST, Portrait, UnderNoise, portraits, under_noise
from graphface.nodes.types import Segmentation


def drawn(size):
    photo, landmarks, _ = portrait(size)
    return Portrait("drawn", photo, landmarks)


class TestUnderNoise:
    def test_drawn_head_keeps_its_labels(self):
        """Noise of one level leaves every label's overlap with itself at 0.98 or more."""
        found = under_noise(drawn(300), segmentation_graph(points=True))
        assert found.worst >= 0.98
        assert sum(found.shares) == pytest.approx(1)

    def test_no_seeds_no_jump(self):
        """Without noise nothing is compared."""
        assert under_noise(drawn(120), segmentation_graph(points=True), seeds=0).overlaps == (1, 1, 1)

    def test_noise_is_seen(self, monkeypatch):
        """Labels that follow single levels are found out."""

        def by_level(labels: Segmentation):
            return np.rint(labels.face * 1e4).astype(int) % 3

        monkeypatch.setattr(segmentation_noise, "likeliest", by_level)
        assert under_noise(drawn(120), segmentation_graph(points=True)).worst < 0.9

    def test_scraps_are_not_judged(self):
        """A label of next to no pixel does not count for the worst."""
        found = UnderNoise("x", overlaps=(0.99, 0.2, 0.985), shares=(0.6, LEAST / 2, 0.4))
        assert found.worst == 0.985

    def test_other_files_are_left_out(self, tmp_path):
        """What is no picture is warned about, and the others are judged."""
        (tmp_path / "index.csv").write_text("a,b")
        with pytest.warns(GraphfaceWarning, match=r"index\.csv is left out"):
            assert list(portraits([tmp_path / "index.csv"])) == []
