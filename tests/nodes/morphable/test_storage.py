"""Face models on disk."""

from __future__ import annotations

import json

import numpy as np
import pytest
from faces import grid_model

from graphface import UnreadableFile, UnwritableFile
from graphface.nodes.morphable.prior import standard
from graphface.nodes.morphable.storage import load_model, refined, save_model


class TestStorage:
    def test_comes_back_as_it_was(self, tmp_path):
        """Everything survives writing and reading."""
        model = grid_model(
            uv=np.zeros((144, 2), np.float32),
            parts=np.arange(144, dtype=np.int32) % 2,
            part_names=("one", "two"),
            prior=standard(3),
            card={"license": "none"},
        )
        save_model(model, tmp_path / "grid.safetensors")
        back = load_model(tmp_path / "grid.safetensors")
        for name in ("mean", "triangles", "uv", "parts"):
            np.testing.assert_array_equal(getattr(back, name), getattr(model, name))
        np.testing.assert_array_equal(back.directions, model.directions)
        np.testing.assert_array_equal(back.prior.covariances, model.prior.covariances)
        np.testing.assert_array_equal(back.landmarks["ibug68"], model.landmarks["ibug68"])
        assert (back.name, back.part_names, back.card) == ("grid", ("one", "two"), {"license": "none"})
        assert back.expression.names == ("c",)

    def test_missing_and_damaged_files_are_named(self, tmp_path):
        """No file, no card, another card, half a file: each says which file and why."""
        path = tmp_path / "grid.safetensors"
        with pytest.raises(UnreadableFile, match="no such file"):
            load_model(path)
        save_model(grid_model(), path)
        card = json.loads(path.with_suffix(".json").read_text())
        path.with_suffix(".json").write_text(json.dumps({**card, "format": "other"}))
        with pytest.raises(UnreadableFile, match="models import"):
            load_model(path)
        path.with_suffix(".json").write_text(json.dumps(card))
        path.write_bytes(path.read_bytes()[:-100])
        with pytest.raises(UnreadableFile, match="not a face model"):
            load_model(path)

    def test_only_safetensors_are_written(self, tmp_path):
        """Another suffix is refused before anything is written."""
        with pytest.raises(UnwritableFile, match="safetensors"):
            save_model(grid_model(), tmp_path / "grid.npz")
        assert not list(tmp_path.iterdir())


class TestRefined:
    def test_four_times_the_triangles_and_the_same_place(self):
        """One level makes four triangles of one; a flat model stays flat."""
        model = grid_model()
        flat = grid_model(mean=model.mean * np.float32([1, 1, 0]))
        finer = refined(flat, 1)
        assert len(finer.triangles) == 4 * len(flat.triangles)
        np.testing.assert_allclose(finer.mean[:, 2], 0, atol=1e-6)
        assert np.ptp(finer.mean[:, 0]) <= np.ptp(flat.mean[:, 0]) + 1e-6

    def test_is_linear(self):
        """Refining a deformed face is deforming the refined face."""
        model = grid_model()
        moved = grid_model(mean=model.vertices(np.array([1.5])).astype(np.float32))
        np.testing.assert_allclose(refined(moved, 1).mean, refined(model, 1).vertices(np.array([1.5])), atol=1e-5)
