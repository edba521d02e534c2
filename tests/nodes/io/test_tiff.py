"""Every layout of a TIFF file is read right or refused, never scrambled."""

from __future__ import annotations

import itertools
import struct
import zlib
from pathlib import Path

import numpy as np
import pytest

from graphface import UnreadableFile
from graphface.nodes.io.image_read import read_image

CASES = Path(__file__).parents[4] / "shared" / "cases"
LAYOUTS = list(itertools.product("<>", [False, True], [None, 16], [False, True], [1, 2]))


def write(path, samples, *, order="<", planar=False, tile=None, deflated=False, predictor=1, extra=None, **tags):
    """A TIFF of samples (H, W, n): its blocks, then its directory."""
    height, width, count = samples.shape
    samples = samples.astype(samples.dtype.newbyteorder(order))
    side, long = (tile, tile) if tile else (10, width)
    planes = [samples[..., k : k + 1] for k in range(count)] if planar else [samples]
    blocks = []
    for plane in planes:
        for top, left in itertools.product(range(0, height, side), range(0, width, long)):
            block = plane[top : top + side, left : left + long]
            if tile:
                block = np.pad(block, [(0, side - block.shape[0]), (0, long - block.shape[1]), (0, 0)])
            if predictor == 2:
                block = np.diff(block, axis=1, prepend=block[:, :1] * 0).astype(samples.dtype)
            raw = block.tobytes()
            blocks.append(zlib.compress(raw) if deflated else raw)
    places = np.cumsum([8, *map(len, blocks)])
    kind = {"u": 1, "f": 3, "i": 2}[samples.dtype.kind]
    found = {
        256: [width],
        257: [height],
        258: [samples.dtype.itemsize * 8] * count,
        259: [8 if deflated else 1],
        262: [2 if count > 2 else 1],
        277: [count],
        284: [2 if planar else 1],
        317: [predictor],
        339: [kind] * count,
        (324 if tile else 273): places[:-1],
        (325 if tile else 279): list(map(len, blocks)),
        **({322: [tile], 323: [tile]} if tile else {278: [side]}),
        **({338: [extra]} if extra is not None else {}),
        **{int(tag.lstrip("t")): [value] for tag, value in tags.items()},
    }
    base = int(places[-1])
    outside = base + 2 + 12 * len(found) + 4
    entries, further = b"", b""
    for tag, values in sorted(found.items()):
        packed = struct.pack(f"{order}{len(values)}I", *map(int, values))
        if len(packed) > 4:
            packed, further = struct.pack(f"{order}I", outside + len(further)), further + packed
        entries += struct.pack(f"{order}HHI", tag, 4, len(values)) + packed
    head = (b"II*\0" if order == "<" else b"MM\0*") + struct.pack(f"{order}I", base)
    directory = struct.pack(f"{order}H", len(found)) + entries + bytes(4) + further
    path.write_bytes(head + b"".join(blocks) + directory)


def picture(count, dtype):
    unit = np.random.default_rng(1).random((23, 37, count))
    return (unit * np.iinfo(dtype).max).astype(dtype) if np.dtype(dtype).kind == "u" else unit.astype(dtype)


def unit_of(samples):
    return samples / np.float64(np.iinfo(samples.dtype).max if samples.dtype.kind == "u" else 1)


class TestLayouts:
    @pytest.mark.parametrize("dtype", ["u1", "u2", "u4", "f2", "f4", "f8"])
    @pytest.mark.parametrize("count", [1, 2, 3, 4])
    def test_every_one(self, tmp_path, dtype, count):
        """Strips and tiles, planes and pixels, either byte order, with and without compression and differences."""
        samples = picture(count, dtype)
        color = unit_of(samples)[..., : count - (count in (2, 4))]
        for order, planar, tile, deflated, predictor in LAYOUTS:
            if predictor == 2 and dtype[0] == "f":
                continue
            how = {"planar": planar, "tile": tile, "deflated": deflated, "predictor": predictor}
            write(tmp_path / "a.tif", samples, order=order, extra=2 if count in (2, 4) else None, **how)
            image = read_image(tmp_path / "a.tif")
            np.testing.assert_allclose(image.pixels, np.broadcast_to(color, image.pixels.shape), atol=1e-3)
            if count in (2, 4):
                np.testing.assert_allclose(image.alpha, unit_of(samples)[..., -1], atol=1e-3)
            else:
                assert image.alpha is None

    @pytest.mark.parametrize("dtype", ["u1", "u2", "f4"])
    @pytest.mark.parametrize("count", [2, 4])
    def test_kinds_of_alpha(self, tmp_path, dtype, count):
        """Premultiplied colors are divided; a further sample that is no alpha is left out."""
        straight = picture(count, "f8")
        straight[..., -1] = 0.5 + straight[..., -1] / 2
        multiplied = straight.copy()
        multiplied[..., :-1] *= multiplied[..., -1:]
        scale = np.iinfo(dtype).max if dtype[0] == "u" else 1
        write(tmp_path / "a.tif", (multiplied * scale).astype(dtype), extra=1)
        image = read_image(tmp_path / "a.tif")
        np.testing.assert_allclose(image.pixels, np.broadcast_to(straight[..., :-1], image.pixels.shape), atol=0.01)
        np.testing.assert_allclose(image.alpha, straight[..., -1], atol=0.01)
        write(tmp_path / "a.tif", (straight * scale).astype(dtype), extra=0)
        assert read_image(tmp_path / "a.tif").alpha is None

    def test_white_is_zero(self, tmp_path):
        """As fax machines have it."""
        samples = picture(1, "u2")
        write(tmp_path / "a.tif", samples, t262=0)
        np.testing.assert_allclose(read_image(tmp_path / "a.tif").pixels[..., :1], 1 - unit_of(samples), atol=1e-3)

    def test_orientation(self, tmp_path):
        """It is applied once."""
        samples = picture(3, "u2")
        write(tmp_path / "a.tif", samples, t274=3)
        np.testing.assert_allclose(read_image(tmp_path / "a.tif").pixels, unit_of(samples)[::-1, ::-1], atol=1e-3)

    @pytest.mark.skipif(not CASES.is_dir(), reason="needs ../shared/cases")
    def test_case(self):
        """A file that came out too dark by 0.27 at half alpha: its colors now go on where alpha falls."""
        image = read_image(CASES / "assoc_alpha_tiff16" / "assoc16.tif")
        half = (image.alpha > 0.4) & (image.alpha < 0.6)
        assert image.pixels[half].mean() > 0.27


class TestRefused:
    @pytest.mark.parametrize(
        ("samples", "tags"),
        [
            (np.ones((4, 4, 3), np.int16), {}),
            (np.ones((4, 4, 4), np.uint16), {"t262": 5}),
            (np.ones((4, 4, 9), np.uint16), {"planar": True}),
        ],
    )
    def test_kinds(self, tmp_path, samples, tags):
        """Signed numbers, deep inks and many planes are named."""
        write(tmp_path / "a.tif", samples, **tags)
        with pytest.raises(UnreadableFile, match=r"this kind of TIFF \(. samples of 16 bits"):
            read_image(tmp_path / "a.tif")

    @pytest.mark.parametrize("tags", [{"t278": 1}, {"t317": 3}, {"t273": 1 << 30}, {"t279": 7}])
    def test_damage(self, tmp_path, tags):
        """Blocks that do not fit the picture."""
        write(tmp_path / "a.tif", picture(3, "u2")[:8], **tags)
        with pytest.raises(UnreadableFile, match=r"damaged or cut off"):
            read_image(tmp_path / "a.tif")

    def test_big_endian_bigtiff(self, tmp_path):
        """It is named."""
        (tmp_path / "a.tif").write_bytes(b"MM\0+\0\x08\0\0" + bytes(40))
        with pytest.raises(UnreadableFile, match="big-endian BigTIFF"):
            read_image(tmp_path / "a.tif")
