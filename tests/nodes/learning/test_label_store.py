"""Labelled photographs in a folder."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from drawn import PICTURE

from graphface import UnreadableFile
from graphface.nodes.learning import label_store
from graphface.nodes.learning.label_store import kept_pictures, read_picture, write_picture


class TestFiles:
    def test_written_and_read(self, tmp_path: Path):
        """A training picture comes back as it was."""
        write_picture(PICTURE, tmp_path / "a.npz")
        found = read_picture(tmp_path / "a.npz")
        assert found.name == PICTURE.name
        for name in ("pixels", "inside", "labels", "person", "plate"):
            np.testing.assert_array_equal(getattr(found, name), getattr(PICTURE, name))
        np.testing.assert_array_equal(found.landmarks.points, PICTURE.landmarks.points)
        assert found.landmarks.scheme == PICTURE.landmarks.scheme

    def test_other_files(self, tmp_path: Path):
        """What is no training picture is refused."""
        (tmp_path / "a.npz").write_bytes(b"nothing")
        with pytest.raises(UnreadableFile, match="not a training picture"):
            read_picture(tmp_path / "a.npz")


class TestKeptPictures:
    def test_labelled_once(self, tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
        """A photograph is labelled once, and again when it has changed; without a folder each time."""

        def labelled(paths):
            for path in paths:
                with path.with_suffix(".calls").open("a") as calls:
                    calls.write("x")
                yield replace(PICTURE, name=path.stem)

        monkeypatch.setattr(label_store, "photo_pictures", labelled)
        photo, folder, calls = tmp_path / "a.jpg", tmp_path / "kept", tmp_path / "a.calls"
        photo.write_bytes(b"one")
        for _ in range(2):
            assert [picture.name for picture in kept_pictures([photo], folder)] == ["a"]
            assert calls.read_text() == "x"
        photo.write_bytes(b"two")
        assert len(list(kept_pictures([photo], folder))) == 1
        assert calls.read_text() == "xx"
        assert len(list(kept_pictures([photo], None))) == 1
        assert calls.read_text() == "xxx"
