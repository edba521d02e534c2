"""Closed-form matting in the band and for the whole picture: the same alphas, and what each way costs.

The whole picture is solved as PyMatting does with its own defaults: the Laplacian of every pixel, known pixels held
with weight 100, incomplete Cholesky factors (threshold 1e-4, once for both labels) and conjugate gradients to 1e-7.
Both ways minimise the same energy, the trust in soft labels included. BLAS keeps to one thread: its threads wait in a
busy loop, which would be counted against PyMatting.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Iterable, Iterator
from contextlib import redirect_stdout
from dataclasses import dataclass
from io import StringIO
from pathlib import Path
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

from graphface.nodes.commands.segmentation_truth import segment_photo
from graphface.nodes.io.image_read import read_image
from graphface.nodes.landmarks.facemesh import facemesh as find_landmarks
from graphface.nodes.matting.band import band_of, likeliest_alphas
from graphface.nodes.matting.closed_form import closed_form
from graphface.nodes.types import Image, Landmarks, Segmentation

T = TypeVar("T")

HELD = 100.0
"""Weight of known pixels: `lambda_value` of PyMatting's make_linear_system."""

WIDTH, STRANDS = 0.06, 0.15
"""Of the band: the defaults of matting.closed_form."""


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


def matting_speed(photos: Iterable[Path], *, trust: float, tolerance: float) -> Iterator[Compared]:
    """Solve every photo both ways, at one setting of matting.closed_form."""
    from threadpoolctl import threadpool_limits  # type: ignore[import-untyped]

    warm = False
    for path in photos:
        photo = read_image(path)
        landmarks = find_landmarks(photo)
        labels = segment_photo(photo, landmarks)
        with threadpool_limits(1):
            if not warm:
                closed_form(photo, labels, landmarks)  # compiled code is loaded once
                warm = True
            yield compared(path.stem, photo, labels, landmarks, trust, tolerance)


def compared(
    name: str, photo: Image, labels: Segmentation, landmarks: Landmarks, trust: float, tolerance: float
) -> Compared:
    """One photo with its soft labels, both ways."""
    band = band_of(labels, landmarks.interocular, width=WIDTH, strands=STRANDS)
    unknown = np.zeros(labels.face.shape, bool)
    unknown[band.part] = band.unknown
    whole, whole_seconds = _timed(lambda: whole_picture(photo, labels, unknown, trust))
    found, band_seconds = _timed(
        lambda: closed_form(photo, labels, landmarks, width=WIDTH, strands=STRANDS, trust=trust, tolerance=tolerance)
    )
    apart = np.abs(np.stack([found.face, found.hair, found.background], axis=2) - whole)
    return Compared(
        photo=name,
        size=(photo.height, photo.width),
        share=float(unknown.mean()),
        whole_seconds=whole_seconds,
        band_seconds=band_seconds,
        picture=float(apart.mean(axis=(0, 1)).max()),
        band=float(apart[unknown].mean(axis=0).max()) if unknown.any() else 0.0,
    )


def whole_picture(photo: Image, labels: Segmentation, unknown: NDArray[np.bool_], trust: float) -> NDArray[np.float64]:
    """Alphas of face, hair and background (H x W x 3) by PyMatting's solve for every pixel of the picture."""
    from pymatting.laplacian.cf_laplacian import cf_laplacian
    from pymatting.preconditioner.ichol import ichol
    from pymatting.solver.cg import cg
    from scipy.sparse import diags

    weight = np.where(unknown, trust, HELD).reshape(-1)
    soft = np.stack([labels.face, labels.hair], axis=2)
    held = np.where(unknown[..., None], soft, likeliest_alphas(labels, (slice(None), slice(None)))).reshape(-1, 2)
    laplacian = cf_laplacian(np.clip(photo.pixels, 0, 1).astype(np.float64))
    system = (laplacian + diags(weight)).tocsc()
    with redirect_stdout(StringIO()):  # every shift of the diagonal that it tries in vain is printed
        factors = ichol(system)
    alphas = [np.clip(cg(system, weight * held[:, k], M=factors), 0, 1) for k in range(2)]
    alphas.append(np.clip(1 - alphas[0] - alphas[1], 0, 1))
    return np.stack(alphas, axis=1).reshape(*unknown.shape, 3)


def _timed(work: Callable[[], T]) -> tuple[T, float]:
    """The result, and the CPU seconds of all threads."""
    start = time.process_time()
    result = work()
    return result, time.process_time() - start
