"""Makeup transfer between path-traced heads whose true answer is known, beside simple methods and swapped stages.

`truth/makeup/A_from_B.png` is head A with the whole albedo of head B. What is compared is the face label: with ears and
neck, without hair.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from graphface import Evaluator, MemoryTier, UnreadableFile, load
from graphface.nodes.io.image_read import read_image
from graphface.nodes.io.image_write import write_image
from graphface.nodes.metrics import psnr
from graphface.nodes.types import FloatArray, Image, Mask

if TYPE_CHECKING:
    from graphface import Graph

SWAPS: dict[str, dict[str, str]] = {
    "makeup": {},
    "flow.none": {"pair/flow": "flow.none"},
    "flow.farneback": {"pair/flow": "flow.farneback"},
    "flow.deepflow": {"pair/flow": "flow.deepflow"},
    "flow.tvl1": {"pair/flow": "flow.tvl1"},
    "blend.multiband": {"blended": "blend.multiband"},
    "blend.poisson": {"blended": "blend.poisson"},
}
"""Name to the replacements in makeup.yaml that it stands for."""

INTRINSIC = ("retinex", "multiscale_retinex", "bilateral", "log_tv", "l1_flatten", "bell2014")


@dataclass(frozen=True)
class Scored:
    """One method: means over the pairs. `milliseconds` of processor time, all threads, for the whole transfer of the
    median pair, what each photo gives alone at hand; 0 where not measured."""

    method: str
    psnr: float
    ssim: float
    milliseconds: float


def makeup_truth(data: Path, out: Path, *, swaps: bool = True, intrinsic: bool = False) -> Iterator[Scored]:
    """Every method on every pair; writes `out`/METHOD/A_from_B.png, as score.py reads them.

    Args:
        data: the folder that holds `truth`. out: made where it does not exist.
        swaps: each flow and each blend in turn. intrinsic: each intrinsic method in turn, slow.

    Raises:
        UnreadableFile: there are no pairs at `data`.
    """
    pairs = sorted((data / "truth" / "makeup").glob("*_from_*.png"))
    if not pairs:
        raise UnreadableFile(data / "truth" / "makeup", "holds no pairs (A_from_B.png)")
    yield _scored("unchanged", pairs, out, lambda photo, reference: (read_image(photo), 0.0))
    yield _scored("reinhard", pairs, out, lambda a, b: (reinhard(read_image(a), read_image(b)), 0.0))
    memory = _Representations()
    evaluator = Evaluator(memory=memory)
    yield _scored("pasted", pairs, out, _pasted(evaluator))
    chosen = dict(SWAPS) if swaps else {"makeup": {}}
    if intrinsic:
        nodes = ("pair/face/intrinsic", "pair/other/intrinsic")
        chosen |= {f"intrinsic.{m}": dict.fromkeys(nodes, f"intrinsic.{m}") for m in INTRINSIC}
    for name, replace in chosen.items():
        yield _scored(name, pairs, out, _runs(load("makeup", replace=replace), evaluator, memory))


def reinhard(photo: Image, reference: Image) -> Image:
    """Mean and deviation of each channel, in Lab, over the whole picture (Reinhard et al., Color Transfer, 2001)."""
    import cv2

    own, other = (cv2.cvtColor(np.clip(p.pixels, 0, 1), cv2.COLOR_RGB2LAB) for p in (photo, reference))
    scale = other.std(axis=(0, 1)) / np.maximum(own.std(axis=(0, 1)), 1e-6)
    moved = (own - own.mean(axis=(0, 1))) * scale + other.mean(axis=(0, 1))
    return photo.with_pixels(np.clip(cv2.cvtColor(moved.astype(np.float32), cv2.COLOR_LAB2RGB), 0, 1))


Method = Callable[[Path, Path], tuple[Image, float]]
"""(photo, reference) to the result and the seconds it took."""


class _Representations(MemoryTier):
    """Keeps what each photo gives alone and, once told, nothing else: every method is then timed whole."""

    keeps = True

    def put(self, key: bytes, value: Any, seconds: float, arrays: tuple[np.ndarray, ...] = ()) -> None:
        if self.keeps:
            super().put(key, value, seconds, arrays)


def _runs(graph: Graph, evaluator: Evaluator, memory: _Representations) -> Method:
    """The graph's image; what each photo gives alone is computed beforehand, so that only the transfer is timed."""
    alone = [f"pair/{f}.{n}" for f in ("face", "other") for n in ("labels", "spread", "mask")]
    alone += ["pair/face_detail", "pair/other_detail", "pair/face_bare", "pair/other_bare", "pair/in_front"]

    def run(photo: Path, reference: Path) -> tuple[Image, float]:
        graph.run(alone, evaluator=evaluator, photo=photo, reference=reference)
        memory.keeps = False
        started = time.process_time()
        image = graph.run(["image"], evaluator=evaluator, photo=photo, reference=reference)["image"]
        taken = time.process_time() - started
        memory.keeps = True
        return image, taken

    return run


def _pasted(evaluator: Evaluator) -> Method:
    """The reference through the meshes, pasted as it is."""
    from graphface.nodes.resample import resampled

    graph = load("makeup", replace={"pair/flow": "flow.none"}, set={"pair/meshes.hidden": "input"})
    asked = ["pair/meshes", "pair.working", "pair.reference_working"]

    def paste(photo: Path, reference: Path) -> tuple[Image, float]:
        result = graph.run(asked, evaluator=evaluator, photo=photo, reference=reference)
        base: Image = result["pair.working"]
        warped = resampled(result["pair.reference_working"].pixels, result["pair/meshes"])
        inside = result["pair/meshes"].inside[..., None]
        return base.with_pixels(base.pixels + inside * (warped - base.pixels)), 0.0

    return paste


def _scored(method: str, pairs: list[Path], out: Path, make: Method) -> Scored:
    rows, seconds = [], []
    (out / method).mkdir(parents=True, exist_ok=True)
    for pair in pairs:
        heads = [pair.parent.parent / name for name in pair.stem.split("_from_")]
        photo, reference = (head / "frontal.png" for head in heads)
        result, taken = make(photo, reference)
        seconds.append(taken)
        write_image(result, out / method / pair.name)
        label = (read_image(heads[0] / "labels.png").pixels[..., 1] > 0.5).astype(np.float32)
        rows.append(_compared(result.pixels, read_image(pair).pixels, label))
    first, second = np.mean(rows, axis=0)
    return Scored(method, float(first), float(second), 1e3 * float(np.median(seconds)))


def _compared(result: FloatArray, truth: FloatArray, label: Mask) -> tuple[float, float]:
    from skimage.metrics import structural_similarity

    shown = np.asarray(np.rint(np.clip(result, 0, 1) * 255) / 255, np.float32)
    maps: Any = structural_similarity(  # type: ignore[no-untyped-call]
        shown.astype(np.float64), truth.astype(np.float64), data_range=1, channel_axis=2, full=True
    )
    return psnr(shown, truth, label), float(maps[1][label > 0].mean())
