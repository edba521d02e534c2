"""Soft edges by the matting Laplacian (paper, section 2).

Levin, Lischinski and Weiss, A Closed-Form Solution to Natural Image Matting, PAMI 2008.

Within every 3 x 3 window alpha is a linear function of the color, up to a ridge. The deviation from that is alpha^T L
alpha, which the right alpha minimizes. Alpha is known outside the band and solved for inside: `laplacian` builds the
system, `coarse` a basis of its smooth solutions, `solve` the solution. One matrix serves face and hair. Background is
the rest to 1: constants are in the Laplacian's null space, so the three solutions would sum to 1.
"""

from __future__ import annotations

from typing import Annotated

import numpy as np
from pydantic import Field

from graphface import Formerly, node, warn
from graphface.nodes.matting.band import band_of, hard_alphas, soft_alphas, with_alphas
from graphface.nodes.matting.coarse import color_lines
from graphface.nodes.matting.laplacian import band_system
from graphface.nodes.matting.solve import solve_alphas
from graphface.nodes.types import Image, Landmarks, Segmentation

_LARGEST_RIDGE = 1e-2
"""Largest epsilon that is tried for a picture without colors."""


@node("matting.closed_form")
def closed_form(
    photo: Image,
    labels: Segmentation,
    landmarks: Landmarks,
    *,
    width: Annotated[float, Field(gt=0, le=2)] = 0.06,
    hair_width: Annotated[float, Field(gt=0, le=2), Formerly("strands")] = 0.15,
    ridge: Annotated[float, Field(ge=1e-12, le=1)] = 1e-7,
    label_weight: Annotated[float, Field(ge=1e-9, le=1), Formerly("trust")] = 1e-4,
    tolerance: Annotated[float, Field(gt=0, le=0.1)] = 3e-3,
) -> Segmentation:
    """Alphas of face, hair and background, solved in the band where labels meet.

    The first call on a machine compiles PyMatting, which takes nearly a minute; the result is kept on disk.

    Args:
        photo: the colors that alphas follow. labels: outside the band the most likely label is certain.
        width, hair_width: half the band's width in inter-ocular distances, in general and between hair and background.
        ridge: Levin's epsilon, for windows of one color.
        label_weight: weight of the soft labels inside the band. It keeps the system regular far from known pixels, and
            keeps alpha from spreading along hair into a face of its color. Less is farther from the truth (hair on
            path-traced heads: overlap 0.967 at 1e-4, 0.933 at 1e-5, 0.904 at 1e-6, which is about Levin's own system).
        tolerance: relative residual at which the solve stops; alphas are then within 0.003 of the exact ones, on
            average over a portrait (`graphface bench matting`).
    """
    band = band_of(labels, max(landmarks.interocular, 1e-3), width=width, hair_width=hair_width)
    if band.empty:
        return labels
    colors = np.clip(np.nan_to_num(photo.pixels[band.part]), 0, 1).astype(np.float64)
    guess = soft_alphas(labels, band)
    known = hard_alphas(labels, band.part)
    system, right = band_system(colors, band.unknown, known, guess, ridge=ridge, label_weight=label_weight)
    # A Laplacian is positive semidefinite. Rounding can make it indefinite where the colors of a window differ by
    # nothing but brightness. A larger epsilon makes no visible difference there.
    while ridge < _LARGEST_RIDGE and len(guess) and system.diagonal().min() < label_weight / 2:
        ridge = min(max(100 * ridge, 1e-7), _LARGEST_RIDGE)
        warn(f"matting.closed_form: some windows have almost no color; solved with an epsilon of {ridge:g}")
        system, right = band_system(colors, band.unknown, known, guess, ridge=ridge, label_weight=label_weight)
    coarse = color_lines(colors, band.unknown)
    return with_alphas(labels, band, solve_alphas(system, right, guess, tolerance=tolerance, coarse=coarse))
