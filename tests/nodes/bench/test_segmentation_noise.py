"""How far labels jump under noise, measured on a drawn head."""

from __future__ import annotations

import numpy as np
import pytest
from portraits import portrait

from graphface import GraphfaceWarning
from graphface.nodes.bench import segmentation_agreement
from graphface.nodes.bench.segmentation_agreement import segment_agreement
from graphface.nodes.bench.segmentation_noise import LEAST, Shaken, portraits, shaken
from graphface.nodes.bench.segmentation_truth import segment_photo


class TestShaken:
    def test_drawn_head_keeps_its_labels(self):
        """Noise of one level leaves every label's overlap with itself at 0.98 or more."""
        photo, landmarks, _ = portrait(300)
        found = shaken("drawn", photo, landmarks)
        assert found.worst >= 0.98
        assert sum(found.shares) == pytest.approx(1)

    def test_no_seeds_no_jump(self):
        """Without noise nothing is compared."""
        photo, landmarks, _ = portrait(120)
        assert shaken("drawn", photo, landmarks, seeds=0).overlaps == (1, 1, 1)

    def test_noise_is_seen(self, monkeypatch):
        """A segmentation that follows single levels is found out."""
        from graphface.nodes.bench import segmentation_noise

        monkeypatch.setattr(
            segmentation_noise, "likeliest", lambda photo, *_: np.rint(photo.pixels[..., 0] * 255).astype(int) % 3
        )
        photo, landmarks, _ = portrait(120)
        assert shaken("drawn", photo, landmarks).worst < 0.5

    def test_scraps_are_not_judged(self):
        """A label of next to no pixel does not count for the worst."""
        found = Shaken("x", overlaps=(0.99, 0.2, 0.985), shares=(0.6, LEAST / 2, 0.4))
        assert found.worst == 0.985

    def test_other_files_are_left_out(self, tmp_path):
        """What is no picture is warned about, and the others are judged."""
        (tmp_path / "index.csv").write_text("a,b")
        with pytest.warns(GraphfaceWarning, match=r"index\.csv is left out"):
            assert list(portraits([tmp_path / "index.csv"])) == []


class TestAgreement:
    def test_of_every_label(self, monkeypatch):
        """Overlaps with the other labels; one that those lack is not judged."""
        photo, landmarks, truth = portrait(120)
        halves = np.where(truth == 1, 0, truth)
        monkeypatch.setattr(segmentation_agreement, "portraits", lambda _: [("drawn", photo, landmarks)])
        monkeypatch.setattr(
            segmentation_agreement, "likeliest", lambda p, at, label: truth if label is segment_photo else halves
        )
        (found,) = segment_agreement([])
        assert found.overlaps == ((truth == 0).sum() / (halves == 0).sum(), None, 1.0)
        assert found.worst == found.overlaps[0]
