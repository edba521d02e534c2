"""Models by name."""

from __future__ import annotations

import pytest
from faces import grid_model

from graphface import UsageError
from graphface.nodes.morphable.library import library, named_model
from graphface.nodes.morphable.storage import save_model


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
