"""How large a picture may be."""

from __future__ import annotations

from pathlib import Path

import pytest

from graphface import GraphfaceWarning, UnreadableFile
from graphface.nodes.io import picture_size
from graphface.nodes.io.picture_size import check_size, free_memory, memory_limit, pixel_limit

A = Path("a.png")


class TestCheckSize:
    def test_within(self):
        """A photo is no problem."""
        check_size(A, 4000, 3000, 19)

    def test_pixels(self, monkeypatch):
        """Too many are named, with the limit."""
        with pytest.raises(UnreadableFile, match=r"a.png: claims 20000 x 10001 pixels, more than 200 million"):
            check_size(A, 20000, 10001, 1)
        monkeypatch.setenv("GRAPHFACE_MAX_PIXELS", "100")
        assert pixel_limit() == 100

    def test_memory(self, monkeypatch):
        """Few enough pixels that take too much memory too, with what they take."""
        with pytest.raises(
            UnreadableFile, match=r"14000 x 14000 pixels takes about 3.7 GB of memory, more than 2.0 GB"
        ):
            check_size(A, 14000, 14000, 19)
        monkeypatch.setenv("GRAPHFACE_MAX_PICTURE_MEMORY", "4G")
        assert memory_limit() == 4e9

    def test_free(self, monkeypatch):
        """What is free binds as well; where nobody knows it, the limit alone does."""
        monkeypatch.setattr(picture_size, "free_memory", lambda: 10**8)
        with pytest.raises(UnreadableFile, match=r"takes about 0.2 GB of memory, and 0.1 GB are free"):
            check_size(A, 4000, 3000, 19)
        monkeypatch.setattr(picture_size, "free_memory", lambda: None)
        check_size(A, 4000, 3000, 19)

    @pytest.mark.parametrize(("variable", "limit"), [("PIXELS", pixel_limit), ("PICTURE_MEMORY", memory_limit)])
    def test_no_number(self, monkeypatch, variable, limit):
        """A limit that is none is warned of."""
        monkeypatch.setenv(f"GRAPHFACE_MAX_{variable}", "much")
        with pytest.warns(GraphfaceWarning, match="much"):
            assert limit() > 1e8


def test_free_memory():
    """It is a number of bytes, or not known."""
    assert free_memory() is None or free_memory() > 0
