"""Maps: normals as color, depth, detail, gain, albedo, shading, face coordinates."""

from __future__ import annotations

from typing import Any

import numpy as np

from graphface.nodes.harmonics import has_surface
from graphface.nodes.pictures.photo import Pixels, backdrop
from graphface.nodes.types import (
    Albedo,
    Depth,
    Detail,
    FaceCoordinates,
    FloatArray,
    Gain,
    Normals,
    RefinedSurface,
    Shading,
    Surface,
)
from graphface.pictures.colors import as_bytes, share_beyond, with_odd
from graphface.values.picture import Picture, View

RGB = ("red", "green", "blue")
_NORMALS = "red is to the right, green up, blue towards the viewer; black: no surface"


def draw_albedo(albedo: Albedo, view: View) -> Picture:
    """Mid grey is 1, the mean of color over intensity."""
    return _map(albedo, view, albedo_bytes, "mid grey is 1, white 2, black 0", over=2)


def draw_gain(gain: Gain, view: View) -> Picture:
    """Mid grey is 1."""
    return _map(gain, view, albedo_bytes, "mid grey is a factor of 1, white 2, black 0", over=2)


def draw_detail(detail: Detail, view: View) -> Picture:
    """Mid grey is 0."""
    return _map(detail, view, signed_bytes, "mid grey is 0, white 0.5, black -0.5", over=0.5)


def draw_shading(shading: Shading, view: View) -> Picture:
    """Black is 0, white is 1; around mid grey where it is signed, as a residual."""
    seen = view.sampled(shading)
    if seen.size and np.nanmin(seen) < 0:
        return _map(shading, view, signed_bytes, "mid grey is 0, white 0.5, black -0.5", over=0.5)
    return _map(shading, view, as_bytes, "black is 0, white 1", over=1)


def draw_normals(normals: Normals, view: View) -> Picture:
    """Colors (n + 1) / 2; black where there is no surface."""
    seen = view.sampled(normals)
    return Picture(normals_bytes(seen), with_odd(_NORMALS, seen), seen, ("x", "y", "z"), _full(normals))


def draw_depth(depth: Depth, view: View) -> Picture:
    """Near is light, far is dark, black where there is no surface."""
    seen = view.sampled(depth)
    there = seen[(seen != 0) & np.isfinite(seen)]
    note = "black: no surface"
    if there.size:
        note = f"white is near, {there.max():.4g} px, dark is far, {there.min():.4g} px; {note}"
    return Picture(depth_bytes(seen), with_odd(note, seen), seen, ("depth",), _full(depth))


def draw_surface(surface: Surface, view: View) -> Picture:
    """Its normals as colors."""
    normals, depth = view.sampled(surface.normals), view.sampled(surface.depth)
    data = np.concatenate([normals, depth[..., None]], axis=2)
    pixels = normals_bytes(normals)
    return Picture(pixels, with_odd(_NORMALS, data), data, ("x", "y", "z", "depth"), _full(surface.depth))


def draw_refined(refined: RefinedSurface, view: View) -> Picture:
    """The surface's normals as colors, dark in a cast shadow."""
    surface = refined.surface
    normals, depth, shadow = (view.sampled(part) for part in (surface.normals, surface.depth, refined.shadow))
    data = np.concatenate([normals, depth[..., None], shadow[..., None]], axis=2)
    pixels = np.asarray(normals_bytes(normals) * (1 - 0.7 * np.clip(np.nan_to_num(shadow), 0, 1))[..., None], np.uint8)
    note = with_odd(f"{_NORMALS}; dark: cast shadow", data)
    return Picture(pixels, note, data, ("x", "y", "z", "depth", "shadow"), _full(surface.depth))


def draw_coordinates(coordinates: FaceCoordinates, view: View) -> Picture:
    """u as red, v as green, a line at every sixteenth; the photo where there is no face."""
    seen = view.sampled(coordinates)
    known = np.all(seen >= 0, axis=2)
    lines = np.any((seen * 16) % 1 < 0.12, axis=2)
    colors = np.concatenate([seen, np.full((*seen.shape[:2], 1), 0.35, np.float32)], axis=2)
    colors = np.where(lines[..., None], colors * 0.45, colors)
    pixels = np.where(known[..., None], as_bytes(colors), backdrop(view, coordinates.shape, seen.shape))
    note = "red is u, green is v, 0 to 1, a line at each sixteenth; grey: no face"
    return Picture(pixels, with_odd(note, seen), seen, ("u", "v"), _full(coordinates))


def albedo_bytes(values: FloatArray) -> Pixels:
    """Mid grey is 1."""
    return as_bytes(values / 2)


def signed_bytes(values: FloatArray) -> Pixels:
    """Mid grey is 0."""
    return as_bytes(values + np.float32(0.5))


def normals_bytes(normals: Normals) -> Pixels:
    """Colors (n + 1) / 2; black where there is no surface."""
    pixels = as_bytes((normals + 1) / 2)
    pixels[~has_surface(normals)] = 0
    return pixels


def depth_bytes(depth: Depth) -> Pixels:
    """White is near, dark is far, black where there is no surface."""
    covered = depth != 0
    there = depth[covered & np.isfinite(depth)]
    if not there.size:
        return as_bytes(np.where(covered, depth, 0))
    low, high = there.min(), there.max()
    return as_bytes(np.where(covered, 0.15 + 0.85 * (depth - low) / max(high - low, 1e-6), 0))


def _map(values: FloatArray, view: View, bytes_of: Any, note: str, *, over: float) -> Picture:
    """A map by a fixed scale, with the share of the pixels that lie beyond it."""
    seen = view.sampled(values)
    share = share_beyond(seen, over)
    note += f"; {share:.1%} of the pixels lie beyond" if share >= 0.0005 else ""
    channels = RGB if seen.ndim == 3 else ("value",)
    return Picture(bytes_of(seen), with_odd(note, seen), seen, channels, _full(values))


def _full(values: FloatArray) -> tuple[int, int]:
    return values.shape[0], values.shape[1]
