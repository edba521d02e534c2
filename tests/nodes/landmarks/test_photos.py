"""Landmarks on the shared photographs: every face found, close to the marks where there are some."""

import json
import warnings

import numpy as np
import pytest

from graphface import GraphfaceWarning
from graphface.nodes.io.image_read import read_image
from graphface.nodes.landmark_schemes import ibug68
from graphface.nodes.landmarks.facemesh import facemesh

pytestmark = pytest.mark.usefixtures("weights")


class TestPortraits:
    def test_every_kind_of_photograph(self, shared):
        """Of every eighth photograph (portraits, makeup, paint, studio, expressions) the one face is found."""
        photos = sorted(p for p in (shared / "faces").iterdir() if p.suffix != ".csv")[::8]
        assert photos
        for path in photos:
            assert facemesh(read_image(path)).faces == 1, path.name


class TestTightCrops:
    def test_yale_frontal(self, shared):
        """All cropped Yale faces are found whole: the crops are aligned, so all have nearly the same points."""
        photos = sorted((shared / "yaleb").glob("*/*_P00A+000E+00.png"))
        assert photos
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", GraphfaceWarning)
            found = [facemesh(read_image(path)) for path in photos]
        typical = np.median([face.points[:, :2] for face in found], axis=0)
        for path, face in zip(photos, found, strict=True):
            off = np.linalg.norm(face.points[:, :2] - typical, axis=1).mean() / face.interocular
            assert off < 0.15, path.name


class TestTruth:
    @pytest.mark.parametrize("head", ["gt01", "gt02", "gt03", "gt04", "gt05", "gt06"])
    def test_marks(self, shared, head):
        """Brows, nose, eyes and lips of the path-traced heads lie within 6 % of the inter-ocular distance (measured
        3.6 to 4.8; the schemes do not mean quite the same points)."""
        folder = shared / "truth" / head
        marks = np.array(json.loads((folder / "meta.json").read_text())["landmarks68"])
        points = ibug68(facemesh(read_image(folder / "frontal.png")))
        distance = np.linalg.norm(points.points[17:, :2] - marks[17:, :2], axis=1).mean()
        assert distance / points.interocular < 0.06
