"""Contact sheets: captioned pictures in a grid."""

from __future__ import annotations

import numpy as np

from graphface.nodes.bench.contact_sheet import around_face, contact_sheet, mesh_overlay
from graphface.nodes.pictures.photo import bytes_of


class TestContactSheet:
    def test_grid(self):
        """Rows of `columns` cells, each of one width under its caption; the last row may be short."""
        cells = [(str(i), np.full((40, 80, 3), 50 * i, np.uint8)) for i in range(1, 4)]
        sheet = contact_sheet(cells, columns=2, width=100)
        assert sheet.shape == (2 * (50 + 30), 2 * (100 + 4), 3)
        assert sheet[60, 50].tolist() == [50, 50, 50]
        assert sheet[60, 154].tolist() == [100, 100, 100]

    def test_other_shapes(self):
        """Every picture is scaled to the first one's aspect."""
        cells = [("a", np.zeros((10, 10, 3), np.uint8)), ("b", np.full((70, 30, 3), 255, np.uint8))]
        assert contact_sheet(cells, columns=1, width=20)[-1, 5].tolist() == [255, 255, 255]


class TestAroundFace:
    def test_lies_around_the_face(self, make_face):
        """The part has the photo's aspect and holds every landmark."""
        photo, landmarks, _, _ = make_face(size=200, scale=0.15, shift=(40, -20))
        rows, columns = around_face(landmarks, photo, reach=1.7)
        x, y = landmarks.points[:, 0], landmarks.points[:, 1]
        assert columns.start <= x.min() < x.max() <= columns.stop
        assert rows.start <= y.min() < y.max() <= rows.stop
        assert rows.stop - rows.start == columns.stop - columns.start < 200

    def test_face_at_the_edge(self, make_face):
        """It stays inside the picture."""
        photo, landmarks, _, _ = make_face(size=120, scale=0.2, shift=(60, 60))
        rows, columns = around_face(landmarks, photo)
        assert 0 <= rows.start < rows.stop <= 120
        assert 0 <= columns.start < columns.stop <= 120


def test_mesh_overlay(make_face):
    """The mesh changes the photo where the face is and nowhere else."""
    photo, landmarks, mesh, _ = make_face(size=160, scale=0.2)
    changed = (mesh_overlay(photo, mesh, landmarks) != bytes_of(photo)).any(axis=2)
    assert changed[70:90, 70:90].any()
    assert not changed[:20].any()
