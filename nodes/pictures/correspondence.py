"""Where the points of one photo lie in another: displacements as colors with arrows, and a warped checkerboard."""

from __future__ import annotations

import cv2
import numpy as np

from graphface.nodes.pictures.mosaic import mosaic, tile_view
from graphface.nodes.pictures.photo import Pixels, backdrop
from graphface.nodes.types import Correspondence, FloatArray
from graphface.pictures.colors import as_bytes, mark_odd
from graphface.values.picture import Picture, View, picked

_ARROWS = 14
"""Arrows along the longer side."""


def draw_correspondence(correspondence: Correspondence, view: View) -> Picture:
    """Left: displacement, its direction as hue and its length as strength. Right: the reference's pixels as squares."""
    tile = tile_view(view, 2, 2)
    full = (correspondence.places.shape[0], correspondence.places.shape[1])
    places = tile.sampled(correspondence.places)
    valid = tile.sampled(correspondence.valid) * tile.sampled(correspondence.inside)
    shape = places.shape
    shift = places - _own_places(full, (shape[0], shape[1]))
    known = (valid > 0.5) & np.isfinite(shift).all(axis=2)
    usual = np.median(shift[known], axis=0) if known.any() else np.zeros(2, np.float32)
    relative = np.where(known[..., None], shift - usual, 0).astype(np.float32)
    reach = float(np.percentile(np.hypot(relative[..., 0], relative[..., 1])[known], 98)) if known.any() else 0.0
    reach = max(reach, 1e-6)
    under = backdrop(tile, full, shape)
    colors = np.where(known[..., None], flow_colors(relative / np.float32(reach)), under)
    mark_odd(colors, places)
    _arrows(colors, relative / np.float32(reach), known)
    _wheel(colors)
    data = np.concatenate([places, valid[..., None]], axis=2)
    names = ("x in the reference", "y in the reference", "valid")
    board = _board(correspondence, places)
    checker = np.where(known[..., None], board, under)
    mark_odd(checker, places)
    note = (
        f"displacement: hue is its direction, full color {reach:.3g} px, from the median "
        f"({usual[0]:.3g}, {usual[1]:.3g}) px; squares: pixels of the reference; "
        f"{known.mean():.0%} of the picture corresponds"
    )
    parts = {"displacement": colors, "reference": checker}
    return mosaic([(name, Picture(drawn, "", data, names, full)) for name, drawn in parts.items()], note, columns=2)


def flow_colors(flow: FloatArray) -> Pixels:
    """Vectors H x W x 2 as colors: the direction is the hue (red to the right, yellow-green down), length 1 is full.

    The form of the Middlebury flow benchmark (Baker et al. 2011), with the hues of HSV.
    """
    angle = np.degrees(np.arctan2(flow[..., 1], flow[..., 0])) % 360
    strength = np.clip(np.hypot(flow[..., 0], flow[..., 1]), 0, 1)
    hsv = np.stack([angle, strength, np.ones_like(strength)], axis=2).astype(np.float32)
    return np.rint(np.asarray(cv2.cvtColor(hsv, cv2.COLOR_HSV2RGB)) * 255).astype(np.uint8)


def _own_places(full: tuple[int, int], shown: tuple[int, int]) -> FloatArray:
    """The position in the photo of every pixel that is shown."""
    x, y = np.meshgrid(picked(full[1], shown[1]), picked(full[0], shown[0]))
    return np.stack([x, y], axis=2).astype(np.float32)


def _arrows(pixels: Pixels, flow: FloatArray, known: np.ndarray) -> None:
    step = max(6, max(pixels.shape[:2]) // _ARROWS)
    for y in range(step // 2, pixels.shape[0], step):
        for x in range(step // 2, pixels.shape[1], step):
            if known[y, x]:
                dx, dy = np.clip(flow[y, x], -1.5, 1.5) * (0.8 * step)
                tip = (round(x + float(dx)), round(y + float(dy)))
                cv2.arrowedLine(pixels, (x, y), tip, (20, 20, 20), 1, cv2.LINE_AA, tipLength=0.3)


def _wheel(pixels: Pixels) -> None:
    """The legend, in the lower right corner."""
    side = min(pixels.shape[:2]) // 6
    if side < 12:
        return
    at = (np.arange(side) + 0.5 - side / 2) / (side / 2)
    flow = np.stack(np.meshgrid(at, at), axis=2).astype(np.float32)
    inside = (np.hypot(flow[..., 0], flow[..., 1]) <= 1)[..., None]
    corner = pixels[-side:, -side:]
    corner[:] = np.where(inside, flow_colors(flow), corner)


def _board(correspondence: Correspondence, places: FloatArray) -> Pixels:
    """A checkerboard over the reference, 32 squares along its longer side, each row and column with its own hue."""
    height, width = correspondence.size
    cell = max(height, width, 1) / 32
    square = np.floor(np.nan_to_num(places) / cell)
    dark = (square.sum(axis=2) % 2)[..., None]
    x, y = square[..., 0] * cell / max(width, 1), square[..., 1] * cell / max(height, 1)
    colors = np.stack([0.25 + 0.7 * x, 0.25 + 0.7 * y, 0.95 - 0.7 * x], axis=2)
    return as_bytes(np.where(dark > 0, colors, 0.45 * colors))
