"""The model container: what it refuses, and that it comes back from disk as it was."""

from __future__ import annotations

import json

import numpy as np
import pytest
from faces import grid_model

from graphface import UnreadableFile, UnwritableFile, UsageError
from graphface.nodes.morphable.builtin import BUILTIN, builtin_model
from graphface.nodes.morphable.library import library, named_model
from graphface.nodes.morphable.mirror import mirror_vertices
from graphface.nodes.morphable.model import Basis, InvalidModel
from graphface.nodes.morphable.prior import standard
from graphface.nodes.morphable.storage import load_model, refined, save_model


class TestMorphableModel:
    @pytest.mark.parametrize(
        ("changes", "reason"),
        [
            ({"triangles": np.array([[0, 1, 999]], np.int32)}, "outside"),
            ({"mean": np.zeros((3, 3), np.float32)}, "mean has the shape"),
            (
                {"identity": Basis(np.zeros((1, 5, 3), np.float32), np.ones(1, np.float32), ("a",))},
                "identity directions",
            ),
            ({"identity": Basis(np.zeros((2, 144, 3), np.float32), np.ones(2, np.float32), ("a",))}, "1 names"),
            ({"landmarks": {}}, "no landmark scheme"),
            ({"landmarks": {"ibug68": np.zeros(5, np.int32)}}, "5 vertices"),
            ({"landmarks": {"ibug68": np.full(68, -1, np.int32)}}, "at least 6"),
            ({"uv": np.zeros((2, 2), np.float32)}, "uv has the shape"),
            ({"parts": np.zeros(2, np.int32)}, "parts has 2"),
            ({"prior": standard(9)}, "prior is over 9"),
        ],
    )
    def test_names_what_does_not_agree(self, changes, reason):
        """Parts that do not agree are refused, with the sizes in the message."""
        with pytest.raises(InvalidModel, match=reason):
            grid_model(**changes)

    def test_refuses_values_that_are_not_numbers(self):
        """A mean with NaN is no face."""
        mean = grid_model().mean.copy()
        mean[0] = np.nan
        with pytest.raises(InvalidModel, match="not numbers"):
            grid_model(mean=mean)

    def test_vertices_are_linear_in_the_coefficients(self):
        """F(a) - F(0) is the sum of the directions times a; missing coefficients are zero."""
        model = grid_model()
        expected = model.mean + 2 * model.identity.directions[0] - model.identity.directions[1]
        np.testing.assert_allclose(model.vertices(np.array([2.0, -1.0])), expected, atol=1e-5)


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


class TestBuiltin:
    def test_is_small_and_says_where_it_comes_from(self):
        """Well under a megabyte, with the command, the figures, the sources and the limits on its card."""
        assert BUILTIN.stat().st_size < 300_000
        card = builtin_model().card
        assert {"command", "figures", "learned_from", "limits", "license"} <= set(card)
        assert card["figures"]["left_unseen"] < 0.15

    def test_is_symmetric(self):
        """Every vertex has a mirror partner, on the mean and, up to sign, in every direction."""
        model = builtin_model()
        mirror = mirror_vertices(model)
        np.testing.assert_allclose(model.mean[mirror] * (-1, 1, 1), model.mean, atol=5e-3)

    def test_a_lopsided_model_has_no_mirror(self):
        """A model that is not symmetric says so instead of pairing strangers."""
        mean = grid_model().mean.copy()
        mean[:, 0] += 0.1 * mean[:, 1]
        assert mirror_vertices(grid_model(mean=mean)) is None

    def test_unit_and_pose(self):
        """The outer eye corners are about one apart, and the nose points at the viewer."""
        model = builtin_model()
        points = model.mean[model.landmarks["ibug68"]]
        assert np.linalg.norm(points[45] - points[36]) == pytest.approx(1, abs=0.05)
        assert points[30, 2] == points[17:, 2].max()


class TestLibrary:
    def test_lists_the_builtin_and_what_was_imported(self, tmp_path, monkeypatch):
        """Files in the user's model folder are models by name."""
        monkeypatch.setenv("GRAPHFACE_MODELS", str(tmp_path))
        save_model(grid_model(), tmp_path / "mine.safetensors")
        assert list(library()) == ["builtin", "mine"]
        assert named_model("mine").name == "grid"

    def test_unknown_names_are_answered_with_near_ones(self, tmp_path, monkeypatch):
        """A misspelt name is the user's mistake, and the likely one is named."""
        monkeypatch.setenv("GRAPHFACE_MODELS", str(tmp_path))
        with pytest.raises(UsageError, match="builtin"):
            named_model("buildin")
