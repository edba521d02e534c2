"""Kinds of face models."""

from __future__ import annotations

import pytest

from graphface import UnreadableFile, UsageError
from graphface.nodes.morphable.readers import guess_kind, read_model


class TestGuessKind:
    def test_says_what_it_does_not_know(self, tmp_path):
        """An unknown file is answered with the kinds there are."""
        with pytest.raises(UsageError, match="ict, surrey, flame, basel"):
            guess_kind(tmp_path / "face.xyz")


class TestReadModel:
    def test_missing_files_and_unknown_kinds(self, tmp_path):
        """Both are named."""
        with pytest.raises(UnreadableFile, match="no such file"):
            read_model(tmp_path / "face.npz")
        with pytest.raises(UsageError, match="unknown kind of face model 'other'"):
            read_model(tmp_path, kind="other")
