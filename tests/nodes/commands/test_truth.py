"""The bench on path-traced heads: a quality gate, where the data and the networks are at hand."""

from __future__ import annotations

import json

import numpy as np
import pytest

from graphface import UnreadableFile
from graphface.assets.asset import AssetUnavailable
from graphface.nodes.commands.truth import LIGHTS, known_scene, relight_truth
from graphface.nodes.io.image_read import read_image
from graphface.nodes.render.irradiance import irradiance


@pytest.fixture(scope="module")
def rows(shared, tmp_path_factory):
    out = tmp_path_factory.mktemp("relit")
    try:
        return list(relight_truth(shared, out)), out
    except AssetUnavailable as error:
        pytest.skip(str(error))


class TestRelightTruth:
    def test_writes_a_picture_for_every_head_and_light(self, rows):
        """HEAD/LIGHT.png, of the photo's size, as the scoring script wants them."""
        figures, out = rows
        assert len(figures) == 6 * len(LIGHTS)
        for row in figures:
            picture = read_image(out / row.head / f"{row.light}.png")
            assert (picture.height, picture.width) == (512, 512)

    def test_beats_the_unchanged_photo(self, rows):
        """On every head under left45, right45 and top, by 5 dB of PSNR and by something at the best exposure."""
        for row in rows[0]:
            if row.light in ("left45", "right45", "top"):
                assert row.psnr > row.unchanged_psnr + 5, row
                assert row.si_psnr > row.unchanged_si_psnr + 0.5, row

    @pytest.mark.parametrize(
        ("light", "least"),
        [("left45", 24.9), ("right45", 24.5), ("top", 22.9), ("left80_hard", 22.2), ("red_blue", 24.7)],
    )
    def test_keeps_its_quality(self, rows, light, least):
        """Mean scale-invariant PSNR per light stays near what was reached (25.2, 24.8, 23.2, 22.5, 25.0 dB)."""
        assert np.mean([row.si_psnr for row in rows[0] if row.light == light]) > least

    def test_normals_keep_their_error(self, rows):
        """The mesh's normals are within 14 degrees of the truth on average, and within 20 on each head."""
        errors = [row.normal_error for row in rows[0]]
        assert np.mean(errors) < 14
        assert max(errors) < 20

    def test_no_heads_is_an_error(self, tmp_path):
        """A folder without truth is named."""
        with pytest.raises(UnreadableFile, match="no heads"):
            next(relight_truth(tmp_path, tmp_path))


class TestKnownScene:
    def test_units(self):
        """An ambient radiance of one is an irradiance of pi; an area light adds radiance times solid angle."""
        area = {"direction": [0, 0, 2], "half_size": 10, "distance": 100, "radiance": [5, 5, 5]}
        meta = json.loads(json.dumps({"ambient": 1.0, "area": [area]}))
        received = irradiance(known_scene(meta), np.float32([[0, 0, 1], [0, 0, -1]]))
        np.testing.assert_allclose(received, [np.pi + 5 * 0.04, np.pi], rtol=1e-5)
