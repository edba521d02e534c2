"""Files of human judgements."""

from __future__ import annotations

import json
from typing import ClassVar

import numpy as np
import pytest

import graphface
from graphface.nodes.io.judgements import read_judgements


class TestJudgements:
    STORED: ClassVar[dict[str, object]] = {
        "intrinsic_points": [{"id": 7, "x": 0.1, "y": 0.5}, {"id": 8, "x": 0.9, "y": 0.5}],
        "intrinsic_comparisons": [
            {"point1": 7, "point2": 8, "darker": "1", "darker_score": 0.75},
            {"point1": 7, "point2": 8, "darker": "E", "darker_score": 0.25},
            {"point1": 7, "point2": 8, "darker": None, "darker_score": None},
        ],
    }

    def test_read_and_measured_in_a_graph(self, tmp_path):
        """The form of Intrinsic Images in the Wild; undecided comparisons do not count."""
        (tmp_path / "judged.json").write_text(json.dumps(self.STORED))
        albedo = np.ones((2, 2, 3), np.float32)
        albedo[:, 0] = 0.5
        graph = graphface.load(
            {
                "graphface": 1,
                "inputs": {"albedo": "Albedo", "judged": "Judgements"},
                "nodes": {"rate": {"use": "metrics.whdr", "in": {"albedo": "albedo", "judgements": "judged"}}},
                "outputs": {"rate": "rate"},
            }
        )
        assert graph.run(albedo=albedo, judged=tmp_path / "judged.json")["rate"] == pytest.approx(0.25)

    @pytest.mark.parametrize("text", ["", "[]", "{}", '{"intrinsic_points": 3, "intrinsic_comparisons": []}'])
    def test_another_file(self, tmp_path, text):
        """A file of another form is refused by name."""
        path = tmp_path / "other.json"
        path.write_text(text)
        with pytest.raises(graphface.UnreadableFile, match=r"other\.json"):
            read_judgements(path)
