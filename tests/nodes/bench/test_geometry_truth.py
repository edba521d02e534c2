"""The bench of geometry, a quality gate, and the `models` command."""

from __future__ import annotations

import json
from statistics import fmean

import numpy as np
import pytest
from typer.testing import CliRunner

from graphface import UnreadableFile
from graphface.assets.asset import AssetUnavailable
from graphface.nodes.bench.geometry_photos import automatic_photos, portrait_residuals, pose_photos
from graphface.nodes.bench.geometry_truth import correlation, geometry_truth
from graphface.nodes.commands import models
from graphface.nodes.morphable.builtin import BUILTIN, builtin_model


@pytest.fixture(scope="module")
def rows(shared):
    try:
        return list(geometry_truth(shared, {"builtin": builtin_model()}))
    except AssetUnavailable as error:
        pytest.skip(str(error))


def mean(rows, geometry, field):
    return fmean(getattr(row, field) for row in rows if row.geometry == geometry)


class TestGeometryTruth:
    def test_the_fit_is_best(self, rows):
        """Mean angle of normals over heads and lights: fit, then the average (by its relief), then the network's own
        depth."""
        fitted, direct, average = (
            mean(rows, name, "normals") for name in ("morphable, builtin", "facemesh", "average, builtin")
        )
        assert fitted < average - 0.5
        assert average < direct - 0.3

    def test_keeps_its_quality(self, rows):
        """Figures stay near what was reached: 11.0 degrees, 5.7 % of the eye distance, depth correlation 0.87."""
        assert mean(rows, "morphable, builtin", "normals") < 11.4
        assert mean(rows, "morphable, builtin", "landmarks") < 6.1
        assert mean(rows, "morphable, builtin", "depth") > 0.84

    def test_no_heads_is_an_error(self, tmp_path):
        """A folder without truth is named."""
        with pytest.raises(UnreadableFile, match="no heads"):
            next(geometry_truth(tmp_path, {}))

    def test_correlation_of_nothing_is_zero(self):
        """A map without variation correlates with nothing."""
        assert correlation(np.ones(5), np.arange(5.0)) == 0
        assert correlation(np.zeros(0), np.zeros(0)) == 0


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

    def test_portraits(self, shared):
        """On portraits the fit leaves less than 1.5 % of the eye distance."""
        try:
            left = [per_cent for _, _, per_cent in portrait_residuals(shared / "portraits", builtin_model(), 40)]
        except AssetUnavailable as error:
            pytest.skip(str(error))
        assert np.median(left) < 1.5


class TestModels:
    def test_list_and_info(self, tmp_path, monkeypatch):
        """The built-in model is listed, and its card shown."""
        monkeypatch.setenv("GRAPHFACE_MODELS", str(tmp_path))
        assert "builtin" in CliRunner().invoke(models.app, ["list"]).output
        shown = CliRunner().invoke(models.app, ["info"]).output
        assert "1833 vertices" in shown
        assert "learned_from" in shown

    def test_import_puts_a_model_into_the_library(self, shared, tmp_path, monkeypatch):
        """An imported model is found by its name."""
        monkeypatch.setenv("GRAPHFACE_MODELS", str(tmp_path))
        done = CliRunner().invoke(models.app, ["import", str(shared / "models" / "sfm"), "--name", "surrey-small"])
        assert done.exit_code == 0
        assert (tmp_path / "surrey-small.safetensors").is_file()
        assert "surrey-small" in CliRunner().invoke(models.app, ["list"]).output

    def test_learn_writes_a_model_and_its_card(self, shared, tmp_path):
        """From a few photographs: a model whose card tells the command and the figures."""
        folder = tmp_path / "few"
        folder.mkdir()
        for photo in sorted((shared / "portraits").glob("*.jpg"))[:8]:
            (folder / photo.name).symlink_to(photo)
        out = tmp_path / "few.safetensors"
        done = CliRunner().invoke(models.app, ["learn", str(folder), "--identity", "3", "--out", str(out)])
        if isinstance(done.exception, AssetUnavailable):
            pytest.skip(str(done.exception))
        assert done.exit_code == 0, done.output
        card = json.loads(out.with_suffix(".json").read_text())
        assert card["command"].startswith("graphface models learn few/")
        assert card["figures"]["faces"] <= 8

    def test_the_shipped_card_is_json(self):
        """The card beside the built-in model is what info shows."""
        assert json.loads(BUILTIN.with_suffix(".json").read_text())["name"] == "builtin"
