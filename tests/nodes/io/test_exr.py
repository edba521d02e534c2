"""OpenEXR: floats go through unchanged, compressed files are read, damage is an error."""

from __future__ import annotations

import struct
import zlib
from contextlib import suppress

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from graphface import UnreadableFile, UnwritableFile
from graphface.nodes.io.exr import read_exr, write_exr


def zipped(path, radiance):
    """Write OpenEXR with ZIP compression, 16 lines to a block, channels as half floats."""
    write_exr(radiance, path)
    data = bytearray(path.read_bytes())
    place = data.index(b"compression\0compression\0") + len(b"compression\0compression\0") + 4
    data[place] = 3
    listed = data.index(b"channels\0chlist\0") + len(b"channels\0chlist\0") + 4
    for channel in range(3):
        data[listed + 18 * channel + 2] = 1
    head = (
        bytes(data[: data.index(b"screenWindowWidth")])
        + b"screenWindowWidth\0float\0"
        + struct.pack("<if", 4, 1)
        + b"\0"
    )
    height = len(radiance)
    blocks = []
    for top in range(0, height, 16):
        lines = np.ascontiguousarray(radiance[top : top + 16, :, ::-1].transpose(0, 2, 1), "<f2").tobytes()
        raw = np.frombuffer(lines, np.uint8)
        split = np.concatenate([raw[0::2], raw[1::2]]).astype(np.int64)
        coded = np.concatenate([split[:1], np.diff(split) + 128]).astype(np.uint8).tobytes()
        packed = zlib.compress(coded)
        packed = packed if len(packed) < len(lines) else lines
        blocks.append(struct.pack("<iI", top, len(packed)) + packed)
    first = len(head) + 8 * len(blocks)
    starts = np.cumsum([0] + [len(b) for b in blocks[:-1]]) + first
    path.write_bytes(head + struct.pack(f"<{len(blocks)}Q", *starts) + b"".join(blocks))


class TestExr:
    @pytest.mark.parametrize("size", [(1, 1), (9, 18), (40, 3)])
    def test_round_trip(self, tmp_path, rng, size):
        """What is written is read again, bit for bit."""
        radiance = (rng.random((*size, 3)) * 20).astype(np.float32)
        write_exr(radiance, tmp_path / "sky.exr")
        np.testing.assert_array_equal(read_exr(tmp_path / "sky.exr"), radiance)

    def test_zip_and_half(self, tmp_path):
        """Compressed half-float files, as panoramas are shared, are read."""
        y, x = np.mgrid[0:40, 0:20].astype(np.float32)
        radiance = np.stack([x, y, x + y], axis=2)
        zipped(tmp_path / "sky.exr", radiance)
        np.testing.assert_array_equal(read_exr(tmp_path / "sky.exr"), radiance)

    @settings(max_examples=60, deadline=None)
    @given(st.integers(0, 2000), st.binary(min_size=1, max_size=8))
    def test_damage_is_an_error_or_harmless(self, tmp_path_factory, place, junk):
        """Whatever bytes are overwritten, reading gives an array or UnreadableFile."""
        path = tmp_path_factory.mktemp("damaged") / "sky.exr"
        zipped(path, np.ones((20, 10, 3), np.float32))
        data = bytearray(path.read_bytes())
        place %= len(data)
        data[place : place + len(junk)] = junk
        path.write_bytes(data)
        with suppress(UnreadableFile):
            assert read_exr(path).ndim == 3

    def test_a_folder_that_does_not_exist(self, tmp_path):
        """Is named."""
        with pytest.raises(UnwritableFile, match="none"):
            write_exr(np.ones((2, 4, 3), np.float32), tmp_path / "none" / "sky.exr")
