"""`graphface models`: listing, describing, importing and learning face models."""

from __future__ import annotations

import json

import pytest
from typer.testing import CliRunner

from graphface.assets.asset import AssetUnavailable
from graphface.nodes.commands import models
from graphface.nodes.morphable.builtin import BUILTIN


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
