"""graphs/align.yaml, and the names that its operators had before."""

from __future__ import annotations

from pathlib import Path

import pytest

from graphface import GraphfaceWarning, load

OLD = """\
graphface: 1
extends: align.yaml
nodes:
  beard:
    use: makeup.shaved
    in: {skin: face_skin, shading: face.shading, features: features, landmarks: face.landmarks}
    with: {strand: 0.03, around: 0.06, cover: 0.4}
  visible:
    use: makeup.uncovered
    in: {skin: face_skin, photo: face.working, labels: face.labels, features: features, landmarks: face.landmarks}
    with: {apart: 3}
  front:
    use: makeup.in_front
    in: {shading: face.shading, features: features, landmarks: face.landmarks}
    with: {size: 0.1}
  recoloured:
    use: transfer.recoloured
    in: {detail: face_detail, reference: face_pigment, albedo: albedo}
  inner:
    use: makeup.core
    in:
      mask: face.mask
      skin: beard
      correspondence: flow
      landmarks: face.landmarks
      in_front: front
      shown: visible
outputs: {inner: inner, recoloured: recoloured}
"""


class TestOldNames:
    def test_still_work(self, tmp_path: Path) -> None:
        """Each is answered with a warning that says the present name, and the graph means the same."""
        (tmp_path / "old.yaml").write_text(OLD)
        with pytest.warns(GraphfaceWarning) as warned:
            graph = load(tmp_path / "old.yaml")
        steps = {step.name: step for step in graph.steps}
        operators = {name: steps[name].operator.name for name in ("beard", "visible", "front", "recoloured", "inner")}
        assert list(operators.values()) == [
            "makeup.beard",
            "makeup.loose_hair",
            "makeup.occluders",
            "transfer.recolored",
            "makeup.core",
        ]
        said = "\n".join(str(w.message) for w in warned)
        for old in ("makeup.shaved", "strand", "around", "cover", "makeup.uncovered", "apart", "makeup.in_front"):
            assert repr(old) in said
        for old in ("size", "transfer.recoloured", "in_front", "shown"):
            assert repr(old) in said
