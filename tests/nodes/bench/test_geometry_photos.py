"""Face models fitted to photographs: a quality gate, where the data is at hand."""

from __future__ import annotations

from statistics import fmean, median

import numpy as np
import pytest

from graphface import GraphfaceWarning, UnreadableFile
from graphface.nodes.bench.geometry_photos import automatic_photos, portrait_residuals, pose_photos
from graphface.nodes.io.image_write import write_picture
from graphface.nodes.morphable.builtin import builtin_model


class TestPhotos:
    def test_large_poses(self, shared):
        """On the 68-point pictures, yaw up to 75 degrees: no failure, error below 3 %, yaw within 7 degrees."""
        fits = list(pose_photos(shared / "landmarks68", builtin_model()))
        assert max(fit.error for fit in fits) < 10
        assert fmean(fit.error for fit in fits) < 3
        assert fmean(abs(fit.yaw - fit.true_yaw) for fit in fits) < 7

    def test_automatic_points(self, shared):
        """On automatic points of video frames: hardly a failure."""
        fits = list(automatic_photos(shared / "people", builtin_model(), every=40))
        assert fmean(fit.error > 10 for fit in fits) < 0.05

    def test_portraits(self, networks, shared):
        """On portraits the fit leaves less than 1.5 % of the eye distance."""
        left = list(portrait_residuals(shared / "portraits", builtin_model(), 40))
        assert median(fit.per_cent for fit in left) < 1.5

    def test_pictures_without_a_face_are_left_out(self, networks, tmp_path):
        """With a warning that names the file."""
        write_picture(np.zeros((64, 64, 3), np.uint8), tmp_path / "black.jpg")
        with pytest.warns(GraphfaceWarning, match=r"black\.jpg is left out"):
            assert list(portrait_residuals(tmp_path, builtin_model())) == []

    def test_folders_without_points(self, tmp_path):
        """They are named."""
        with pytest.raises(UnreadableFile, match="68 points"):
            next(pose_photos(tmp_path, builtin_model()))
        with pytest.raises(UnreadableFile, match="automatic points"):
            next(automatic_photos(tmp_path, builtin_model()))
