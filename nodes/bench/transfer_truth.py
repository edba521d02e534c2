"""Makeup transfer between path-traced heads whose true answer is known, beside simple methods and swapped stages.

Two truths: "full" is the head with the whole albedo of the reference, skin included; "own" is the head's own skin with
only the reference's paint. What is compared is the face label: with ears and neck, without hair.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from graphface import Graph, UnreadableFile, load
from graphface.nodes.bench.heads import Head
from graphface.nodes.bench.metered import MeteredEvaluator
from graphface.nodes.bench.pair_cost import transfer_ms
from graphface.nodes.io.image_read import read_image
from graphface.nodes.io.image_write import write_image
from graphface.nodes.metrics import psnr
from graphface.nodes.types import FloatArray, Image, Mask
from graphface.values.writing import make_folder

SWAPS: dict[str, dict[str, str]] = {
    "makeup": {},
    "paper": {},
    "flow.none": {"pair/flow": "flow.none"},
    "flow.farneback": {"pair/flow": "flow.farneback"},
    "flow.deepflow": {"pair/flow": "flow.deepflow"},
    "flow.tvl1": {"pair/flow": "flow.tvl1"},
    "blend.multiband": {"blended": "blend.multiband"},
    "blend.poisson": {"blended": "blend.poisson"},
}
"""Name to the replacements in makeup.yaml that it stands for; a name that is a variant of it stands for that."""

VARIANTS = ("paper",)

INTRINSIC = ("retinex", "multiscale_retinex", "bilateral", "log_tv", "l1_flatten", "bell2014")

TRUTHS = ("full", "own")

ZONES = ("opaque", "bare")
"""Parts of the face label in which the truth "own" is compared as well: opacity of the paint above 0.5, and 0."""


@dataclass(frozen=True)
class Pair:
    """Head A, the picture of its makeup's reference B, and the true answers by their meaning, of `TRUTHS`.

    `alpha` is the picture of the paint's true opacity, where there is one.
    """

    name: str
    head: Head
    reference: Path
    truths: Mapping[str, Path]
    alpha: Path | None = None


@dataclass(frozen=True)
class Scored:
    """One method: PSNR in dB and SSIM by truth, means over the pairs that have it; by zone of `ZONES` PSNR alone.

    `milliseconds` of CPU for the transfer of the median pair, what each photo gives alone at hand; None where a method
    is no graph.
    """

    method: str
    psnr: Mapping[str, float]
    ssim: Mapping[str, float]
    milliseconds: float | None


Method = Callable[[Path, Path], tuple[Image, float | None]]
"""(photo, reference) to the result and its CPU milliseconds."""


def makeup_truth(data: Path, out: Path, *, swaps: bool = True, intrinsic: bool = False) -> list[Scored]:
    """Every method on every pair; writes `out`/METHOD/A_from_B.png, as score.py reads them.

    Args:
        data: the folder that holds `truth`. out: made where it does not exist.
        swaps: each flow and each blend in turn. intrinsic: each intrinsic method in turn, slow.

    Raises:
        UnreadableFile: there are no pairs at `data`.
    """
    pairs = pairs_of(data)
    chosen = dict(SWAPS) if swaps else {name: SWAPS[name] for name in ("makeup", *VARIANTS)}
    if intrinsic:
        nodes = ("pair/face/intrinsic", "pair/other/intrinsic")
        chosen |= {f"intrinsic.{m}": dict.fromkeys(nodes, f"intrinsic.{m}") for m in INTRINSIC}
    evaluator = MeteredEvaluator()
    methods: dict[str, Method] = {"unchanged": _unchanged, "reinhard": _reinhard, "pasted": _pasted(evaluator)}
    for name, replace in chosen.items():
        # The layer needs no intrinsic images.
        variants = [name] if name in VARIANTS else ["paper"] if name.startswith("intrinsic.") else []
        methods[name] = _runs(load("makeup", replace=replace, variants=variants), evaluator)
    return [_scored(name, method, pairs, out) for name, method in methods.items()]


def pairs_of(data: Path) -> list[Pair]:
    """The pairs of `data`: truth/makeup/A_from_B.png between heads of truth/, and those of makeup/.

    The latter are makeup/A_from_B_full.png and makeup/A_from_B_own.png with the reference makeup/B_makeup.png.

    Raises:
        UnreadableFile: there are none.
    """
    truth, makeup = data / "truth", data / "makeup"
    pairs = []
    for path in sorted((truth / "makeup").glob("*_from_*.png")):
        head, reference = path.stem.split("_from_")
        pairs.append(Pair(path.stem, Head(truth / head), Head(truth / reference).path(), {"full": path}))
    for path in sorted(makeup.glob("*_from_*_full.png")):
        name = path.stem.removesuffix("_full")
        head, reference = name.split("_from_")
        truths = {meaning: makeup / f"{name}_{meaning}.png" for meaning in TRUTHS}
        alpha = makeup / f"{name}_alpha.png"
        found = alpha if alpha.is_file() else None
        pairs.append(Pair(name, Head(truth / head), makeup / f"{reference}_makeup.png", truths, found))
    if not pairs:
        raise UnreadableFile(truth / "makeup", "holds no pairs (A_from_B.png)")
    return pairs


def reinhard(photo: Image, reference: Image) -> Image:
    """Mean and deviation of each channel, in Lab, over the whole picture (Reinhard et al., Color Transfer, 2001)."""
    import cv2

    own, other = (cv2.cvtColor(np.clip(p.pixels, 0, 1), cv2.COLOR_RGB2LAB) for p in (photo, reference))
    scale = other.std(axis=(0, 1)) / np.maximum(own.std(axis=(0, 1)), 1e-6)
    moved = (own - own.mean(axis=(0, 1))) * scale + other.mean(axis=(0, 1))
    return photo.with_pixels(np.clip(cv2.cvtColor(moved.astype(np.float32), cv2.COLOR_LAB2RGB), 0, 1))


def _unchanged(photo: Path, reference: Path) -> tuple[Image, None]:
    return read_image(photo), None


def _reinhard(photo: Path, reference: Path) -> tuple[Image, None]:
    return reinhard(read_image(photo), read_image(reference)), None


def _pasted(evaluator: MeteredEvaluator) -> Method:
    """The reference through the meshes, pasted as it is."""
    from graphface.nodes.resample import resampled

    graph = load("makeup", replace={"pair/flow": "flow.none"}, set={"pair/meshes.hidden": "input"})
    asked = ["pair/meshes", "pair.working", "pair.reference_working"]

    def paste(photo: Path, reference: Path) -> tuple[Image, None]:
        result = graph.run(asked, evaluator=evaluator, photo=photo, reference=reference)
        base: Image = result["pair.working"]
        warped = resampled(result["pair.reference_working"].pixels, result["pair/meshes"])
        inside = result["pair/meshes"].inside[..., None]
        return base.with_pixels(base.pixels + inside * (warped - base.pixels)), None

    return paste


def _runs(graph: Graph, evaluator: MeteredEvaluator) -> Method:
    def run(photo: Path, reference: Path) -> tuple[Image, float]:
        image = graph.run(["image"], evaluator=evaluator, photo=photo, reference=reference)["image"]
        return image, transfer_ms(evaluator, graph)

    return run


def _scored(name: str, method: Method, pairs: list[Pair], out: Path) -> Scored:
    spent: list[float] = []
    figures: dict[str, list[tuple[float, float]]] = {}
    make_folder(out / name)
    for pair in pairs:
        result, milliseconds = method(pair.head.path(), pair.reference)
        spent += [] if milliseconds is None else [milliseconds]
        write_image(result, out / name / f"{pair.name}.png")
        for truth, path in pair.truths.items():
            figures.setdefault(truth, []).append(_compared(result.pixels, read_image(path).pixels, pair.head.face))
        for zone, label in _zones(pair).items():
            figures.setdefault(zone, []).append((_psnr(result.pixels, read_image(pair.truths["own"]).pixels, label), 0))
    means = {truth: np.mean(rows, axis=0) for truth, rows in figures.items()}
    return Scored(
        method=name,
        psnr={truth: float(mean[0]) for truth, mean in means.items()},
        ssim={truth: float(mean[1]) for truth, mean in means.items() if truth in TRUTHS},
        milliseconds=float(np.median(spent)) if spent else None,
    )


def _zones(pair: Pair) -> dict[str, Mask]:
    """Of `ZONES`, the labels that the pair's true opacity gives."""
    if pair.alpha is None or "own" not in pair.truths:
        return {}
    alpha = read_image(pair.alpha).pixels.mean(axis=2)
    parts = dict(zip(ZONES, (alpha > 0.5, alpha == 0), strict=True))
    labels = {zone: np.asarray(pair.head.face * part, np.float32) for zone, part in parts.items()}
    return {zone: label for zone, label in labels.items() if label.any()}


def _psnr(result: FloatArray, truth: FloatArray, label: Mask) -> float:
    """PSNR over a label, of the result as 8 bits hold it."""
    return psnr(np.asarray(np.rint(np.clip(result, 0, 1) * 255) / 255, np.float32), truth, label)


def _compared(result: FloatArray, truth: FloatArray, label: Mask) -> tuple[float, float]:
    """PSNR and SSIM over a label, of the result as 8 bits hold it."""
    from skimage.metrics import structural_similarity

    shown = np.asarray(np.rint(np.clip(result, 0, 1) * 255) / 255, np.float32)
    maps: Any = structural_similarity(  # type: ignore[no-untyped-call]
        shown.astype(np.float64), truth.astype(np.float64), data_range=1, channel_axis=2, full=True
    )
    return _psnr(result, truth, label), float(maps[1][label > 0].mean())
