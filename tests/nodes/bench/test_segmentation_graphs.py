"""The shipped representation with its labels found and matted in other ways."""

from __future__ import annotations

import pytest

from graphface.nodes.bench.segmentation_graphs import LABELLINGS, MATTED, MATTINGS, segmentation_graph, unmatted


def behind(graph, node):
    """Names of the nodes that a node may need, itself included."""
    return {step.name for step in graph.request({}, [node]).steps()}


class TestSegmentationGraph:
    @pytest.mark.parametrize("matting", MATTINGS)
    def test_matting(self, matting):
        """The node that mattes has the operator asked for."""
        (step,) = (step for step in segmentation_graph(matting=matting).steps if step.name == MATTED)
        assert step.operator.name == f"matting.{matting}"

    @pytest.mark.parametrize("labels", LABELLINGS)
    def test_labels(self, labels):
        """What is matted are the labels found in the way asked for."""
        graph = segmentation_graph(labels)
        assert unmatted(labels) in behind(graph, "labels")
        assert ("segment/classes" in behind(graph, "labels")) == (labels != "cue")
        assert ("segment/cue" in behind(graph, "labels")) == (labels in ("cue", "classify"))

    def test_points(self):
        """Landmarks that are given, and no other network is asked for any."""
        assert "points" in segmentation_graph(points=True).inputs
        operators = {step.operator.name for step in segmentation_graph(points=True).steps}
        assert "landmarks.facemesh" not in operators

    def test_settings(self):
        """Parameters of the matting."""
        graph = segmentation_graph(matting="closed_form", settings={"label_weight": 0.5})
        (step,) = (step for step in graph.steps if step.name == MATTED)
        assert step.parameters["label_weight"] == 0.5
