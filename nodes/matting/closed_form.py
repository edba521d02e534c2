"""Soft edges by the matting Laplacian (paper, section 2).

Levin, Lischinski and Weiss, A Closed-Form Solution to Natural Image Matting, PAMI 2008.

Within every 3 x 3 window alpha is a linear function of the color, up to a ridge; what that leaves over is alpha^T L
alpha, least where alpha is right. Known outside of the band, it is solved for inside: `laplacian` builds the system,
`coarse` says what its solutions look like from afar, `solve` finds them. One matrix serves face and hair; background
is what is left, since constants are in the Laplacian's null space: the three alphas sum to 1 by themselves.
"""

from __future__ import annotations

from typing import Annotated

import numpy as np
from pydantic import Field

from graphface import node, warn
from graphface.nodes.matting.band import band_of, likeliest_alphas, merged, soft_alphas
from graphface.nodes.matting.coarse import color_lines
from graphface.nodes.matting.laplacian import band_system
from graphface.nodes.matting.solve import solve_alphas
from graphface.nodes.types import Image, Landmarks, Segmentation

_LARGEST_RIDGE = 1e-2
"""Epsilon that a picture without colors is solved with at the most."""


@node("matting.closed_form")
def closed_form(
    photo: Image,
    labels: Segmentation,
    landmarks: Landmarks,
    *,
    width: Annotated[float, Field(gt=0, le=2)] = 0.06,
    strands: Annotated[float, Field(gt=0, le=2)] = 0.15,
    ridge: Annotated[float, Field(ge=1e-12, le=1)] = 1e-7,
    trust: Annotated[float, Field(ge=1e-9, le=1)] = 1e-4,
    tolerance: Annotated[float, Field(gt=0, le=0.1)] = 3e-3,
) -> Segmentation:
    """Alphas of face, hair and background, solved in the band where labels meet.

    The first call ever on a machine waits for PyMatting to compile itself, nearly a minute; the result is kept on disk.

    Args:
        photo: the colors that alphas follow. labels: those outside of the band are kept as certain.
        width, strands: half the band's width in inter-ocular distances, in general and between hair and background.
        ridge: Levin's epsilon, for windows of one color.
        trust: weight of the soft labels inside the band: keeps the solve regular where nothing known is near, and alpha
            from running along hair into a face of its color. Less is farther from the truth (hair on path-traced
            heads: overlap 0.967 at 1e-4, 0.933 at 1e-5, 0.904 at 1e-6, which is about Levin's own system).
        tolerance: relative residual at which the solve stops; alphas are then within 0.003 of the exact ones, on
            average over a portrait (`graphface bench matting`).
    """
    band = band_of(labels, max(landmarks.interocular, 1e-3), width=width, strands=strands)
    if band.empty:
        return labels
    colors = np.clip(np.nan_to_num(photo.pixels[band.part]), 0, 1).astype(np.float64)
    guess = soft_alphas(labels, band)
    known = likeliest_alphas(labels, band.part)
    system, right = band_system(colors, band.unknown, known, guess, ridge=ridge, trust=trust)
    # A Laplacian is not negative. Where colors of a window are one color to the last bits but for their brightness,
    # rounding can make it so; a larger epsilon cannot be told from a small one there.
    while ridge < _LARGEST_RIDGE and len(guess) and system.diagonal().min() < trust / 2:
        ridge = min(max(100 * ridge, 1e-7), _LARGEST_RIDGE)
        warn(f"matting.closed_form: some windows have no color to speak of; solved with an epsilon of {ridge:g}")
        system, right = band_system(colors, band.unknown, known, guess, ridge=ridge, trust=trust)
    coarse = color_lines(colors, band.unknown)
    return merged(labels, band, solve_alphas(system, right, guess, tolerance=tolerance, coarse=coarse))
