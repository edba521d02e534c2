"""Closed-form matting in the band and for the whole picture: the same alphas, and what each way costs.

The whole picture is solved as PyMatting does with its own defaults: the Laplacian of every pixel, known pixels held
with weight 100, incomplete Cholesky factors (threshold 1e-4, once for both labels) and conjugate gradients to 1e-7.
Both ways minimise the same energy, with the same weight of the soft labels. BLAS keeps to one thread: its threads wait
in a busy loop, which would be counted against PyMatting.
"""

from __future__ import annotations

import time
from collections.abc import Iterable, Iterator
from contextlib import redirect_stdout
from dataclasses import dataclass
from io import StringIO
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from graphface import Graph
from graphface.nodes.bench.metered import MeteredEvaluator
from graphface.nodes.bench.segmentation_graphs import MATTED, segmentation_graph, unmatted
from graphface.nodes.matting.band import band_of, hard_alphas
from graphface.nodes.types import Image, Segmentation

HELD = 100.0
"""Weight of known pixels: `lambda_value` of PyMatting's make_linear_system."""


@dataclass(frozen=True)
class Compared:
    """One photo: `share` of its pixels in the band, CPU seconds of both ways, and how far their alphas are apart.

    `picture` and `band`: mean absolute difference over all pixels and over those of the band, of the label that
    differs most.
    """

    photo: str
    size: tuple[int, int]
    share: float
    whole_seconds: float
    band_seconds: float
    picture: float
    band: float

    @property
    def ratio(self) -> float:
        return self.whole_seconds / max(self.band_seconds, 1e-9)


def matting_speed(photos: Iterable[Path], *, label_weight: float, tolerance: float) -> Iterator[Compared]:
    """Solve every photo both ways, at one setting of matting.closed_form.

    Raises:
        UnreadableFile, RunFailed: a photo cannot be read, or shows no face.
    """
    from threadpoolctl import threadpool_limits  # type: ignore[import-untyped]

    graph = segmentation_graph(matting="closed_form", settings={"label_weight": label_weight, "tolerance": tolerance})
    for path in photos:
        with threadpool_limits(1):
            yield compared(path, graph)


def compared(path: Path, graph: Graph) -> Compared:
    """One photo, both ways; the graph mattes by matting.closed_form."""
    evaluator, classes = MeteredEvaluator(), unmatted()
    graph.run([MATTED], evaluator=evaluator, photo=path)
    evaluator.forget(evaluator.key(MATTED))  # run again: compiled code is loaded once
    made = graph.run(["working", "landmarks", classes, MATTED], evaluator=evaluator, photo=path)
    before, matted, found = evaluator.key(classes), evaluator.key(MATTED), made[MATTED]
    (settings,) = (step.parameters for step in graph.steps if step.name == MATTED)
    photo, labels = made["working"], made[classes]
    band = band_of(labels, made["landmarks"].interocular, width=settings["width"], hair_width=settings["hair_width"])
    unknown = np.zeros(labels.face.shape, bool)
    unknown[band.part] = band.unknown
    start = time.process_time()
    whole = whole_picture(photo, labels, unknown, settings["label_weight"])
    whole_seconds = time.process_time() - start
    apart = np.abs(np.stack([found.face, found.hair, found.background], axis=2) - whole)
    return Compared(
        photo=path.stem,
        size=(photo.height, photo.width),
        share=float(unknown.mean()),
        whole_seconds=whole_seconds,
        band_seconds=evaluator.cpu_ms(matted, [before]) / 1e3,
        picture=float(apart.mean(axis=(0, 1)).max()),
        band=float(apart[unknown].mean(axis=0).max()) if unknown.any() else 0.0,
    )


def whole_picture(
    photo: Image, labels: Segmentation, unknown: NDArray[np.bool_], label_weight: float
) -> NDArray[np.float64]:
    """Alphas of face, hair and background (H x W x 3) by PyMatting's solve for every pixel of the picture."""
    from pymatting.laplacian.cf_laplacian import cf_laplacian
    from pymatting.preconditioner.ichol import ichol
    from pymatting.solver.cg import cg
    from scipy.sparse import diags

    weight = np.where(unknown, label_weight, HELD).reshape(-1)
    soft = np.stack([labels.face, labels.hair], axis=2)
    held = np.where(unknown[..., None], soft, hard_alphas(labels, (slice(None), slice(None)))).reshape(-1, 2)
    laplacian = cf_laplacian(np.clip(photo.pixels, 0, 1).astype(np.float64))
    system = (laplacian + diags(weight)).tocsc()
    with redirect_stdout(StringIO()):  # every shift of the diagonal that it tries in vain is printed
        factors = ichol(system)
    alphas = [np.clip(cg(system, weight * held[:, k], M=factors), 0, 1) for k in range(2)]
    alphas.append(np.clip(1 - alphas[0] - alphas[1], 0, 1))
    return np.stack(alphas, axis=1).reshape(*unknown.shape, 3)
