"""Text kept inside picture files."""

from __future__ import annotations

import io

import PIL.Image as Pillow
import pytest
from pictures import SUFFIXES, exif_block, smooth

from graphface import UnreadableFile
from graphface.nodes.io.image_read import read_image
from graphface.nodes.io.image_text import read_text
from graphface.nodes.io.image_write import write_image
from graphface.nodes.types import FileFormat, Image

TEXTS = {"run": 'graph: é\n  x: "<&>\'"\n', "version": "1"}


class TestText:
    @pytest.mark.parametrize("suffix", SUFFIXES)
    @pytest.mark.parametrize("bits", [8, 16])
    def test_comes_back(self, tmp_path, suffix, bits):
        """Words put into a picture are found again, exactly, beside the EXIF that was there."""
        file = FileFormat(bits=bits, exif=exif_block())
        write_image(Image(smooth(), file=file), tmp_path / f"a{suffix}", text=TEXTS)
        assert read_text(tmp_path / f"a{suffix}") == TEXTS
        assert read_image(tmp_path / f"a{suffix}").file.exif is not None

    @pytest.mark.parametrize("suffix", SUFFIXES)
    def test_long(self, tmp_path, suffix):
        """A long graph fits into every format, compressed where it must."""
        words = {"run": "  node: {use: render.shade}\n" * 20_000}
        write_image(Image(smooth()), tmp_path / f"a{suffix}", text=words)
        assert read_text(tmp_path / f"a{suffix}") == words

    def test_none(self, tmp_path):
        """A picture without words has none."""
        write_image(Image(smooth()), tmp_path / "a.jpg")
        assert read_text(tmp_path / "a.jpg") == {}

    def test_damaged(self, tmp_path):
        """Words that are no longer readable are an error, not a guess."""
        out = io.BytesIO()
        Pillow.new("RGB", (4, 4)).save(out, "JPEG", xmp=b'graphface:text="{broken"')
        (tmp_path / "a.jpg").write_bytes(out.getvalue())
        with pytest.raises(UnreadableFile, match="text inside is damaged"):
            read_text(tmp_path / "a.jpg")
