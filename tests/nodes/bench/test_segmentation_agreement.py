"""How far labels agree with those of a network."""

from __future__ import annotations

import pytest
from portraits import portrait

from graphface import GraphfaceWarning
from graphface.nodes.bench.segmentation_agreement import Agreed, agreement, segment_agreement


class TestAgreement:
    def test_of_every_label(self):
        """Overlaps with the other labels; one that those lack is not judged."""
        truth = portrait(120)[2]
        halves = truth.copy()
        halves[truth == 1] = 0
        found = Agreed("drawn", agreement(truth, halves))
        assert found.overlaps == ((truth == 0).sum() / (halves == 0).sum(), None, 1.0)
        assert found.worst == found.overlaps[0]

    def test_other_files_are_left_out(self, tmp_path):
        """What is no picture is warned about."""
        (tmp_path / "index.csv").write_text("a,b")
        with pytest.warns(GraphfaceWarning, match=r"index\.csv is left out"):
            assert list(segment_agreement([tmp_path / "index.csv"])) == []
