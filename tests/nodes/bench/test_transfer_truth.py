"""Makeup against path-traced answers, and the simple methods beside it."""

from __future__ import annotations

import numpy as np
import pytest

from graphface import UnreadableFile
from graphface.nodes.bench.transfer_truth import makeup_truth, pairs_of, reinhard
from graphface.nodes.io.image_write import write_picture
from graphface.nodes.types import Image


class TestPairs:
    def test_between_heads(self, heads, face):
        """truth/makeup/A_from_B.png: the reference is B's own frontal photo, the truth is the full transfer."""
        (heads / "truth/makeup").mkdir()
        write_picture(face, heads / "truth/makeup/gt01_from_gt02.png")
        (pair,) = pairs_of(heads)
        assert (pair.name, pair.head.name) == ("gt01_from_gt02", "gt01")
        assert pair.reference == heads / "truth/gt02/frontal.png"
        assert list(pair.truths) == ["full"]

    def test_two_meanings(self, shared):
        """makeup/A_from_B_full.png and _own.png: the reference is a picture of its own."""
        pairs = pairs_of(shared / "families")
        assert [pair.name for pair in pairs] == ["hs02_from_hs05", "hs03_from_hs05"]
        for pair in pairs:
            assert list(pair.truths) == ["full", "own"]
            assert all(path.is_file() for path in (*pair.truths.values(), pair.reference, pair.head.path()))

    def test_none(self, tmp_path):
        """A folder without pairs is named."""
        with pytest.raises(UnreadableFile, match="no pairs"):
            pairs_of(tmp_path)


@pytest.mark.filterwarnings("ignore::graphface.GraphfaceWarning")
class TestMakeupTruth:
    def test_better_than_every_simple_method(self, networks, shared, tmp_path):
        """Of moving the whole albedo: 26.5 dB at the least, 3 dB better than pasting, statistics or nothing."""
        scored = {s.method: s.psnr["full"] for s in makeup_truth(shared, tmp_path, swaps=False)}
        others = max(scored[name] for name in ("unchanged", "reinhard", "pasted"))
        assert scored["paper"] > max(26.5, others + 3)

    def test_own_skin_and_only_the_paint(self, networks, shared, tmp_path):
        """On pairs with both truths the layer beats the untouched photo where paint is opaque, and leaves bare skin."""
        scored = {s.method: s.psnr for s in makeup_truth(shared / "families", tmp_path, swaps=False)}
        assert scored["makeup"]["own"] > max(28.0, scored["paper"]["own"] + 8)
        assert scored["makeup"]["opaque"] > scored["unchanged"]["opaque"] + 2.5
        assert scored["makeup"]["bare"] > 33


class TestReinhard:
    def test_statistics_become_the_references(self, rng):
        """Where no value is clipped, the mean colour is the reference's."""
        one, other = (Image((0.4 + 0.1 * rng.random((32, 32, 3)) * s).astype(np.float32)) for s in (1.0, 0.5))
        np.testing.assert_allclose(
            reinhard(one, other).pixels.mean(axis=(0, 1)), other.pixels.mean(axis=(0, 1)), atol=5e-3
        )

    def test_a_flat_photo(self):
        """No deviation to scale: finite."""
        flat = Image(np.full((8, 8, 3), 0.5, np.float32))
        assert np.isfinite(reinhard(flat, flat).pixels).all()
