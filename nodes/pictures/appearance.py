"""A picture's two factors, and what rendering lacks."""

from __future__ import annotations

from graphface.nodes.pictures.maps import draw_albedo, draw_detail, draw_gain, draw_shading
from graphface.nodes.pictures.masks import draw_mask
from graphface.nodes.pictures.mosaic import mosaic, tile_view
from graphface.nodes.pictures.photo import draw_image
from graphface.nodes.types import BareSkin, DetailMap, Image, Intrinsic, Paint
from graphface.values.picture import Picture, View


def draw_intrinsic(intrinsic: Intrinsic, view: View) -> Picture:
    """Albedo and shading side by side."""
    tile = tile_view(view, 2, 2)
    albedo, shading = draw_albedo(intrinsic.albedo, tile), draw_shading(intrinsic.shading, tile)
    note = f"albedo: {albedo.note}; shading: {shading.note}"
    return mosaic([("albedo", albedo), ("shading", shading)], note, columns=2)


def draw_detail_map(detail: DetailMap, view: View) -> Picture:
    """The offset; with a gain both, side by side."""
    if detail.gain is None:
        return draw_detail(detail.offset, view)
    tile = tile_view(view, 2, 2)
    offset, gain = draw_detail(detail.offset, tile), draw_gain(detail.gain, tile)
    return mosaic([("offset", offset), ("gain", gain)], f"offset: {offset.note}; gain: {gain.note}", columns=2)


def draw_bare_skin(bare: BareSkin, view: View) -> Picture:
    """The field of colors."""
    return draw_image(Image(bare.color), view)


def draw_paint(paint: Paint, view: View) -> Picture:
    """Departure and opacity side by side."""
    tile = tile_view(view, 2, 2)
    departure, opacity = draw_detail(paint.departure, tile), draw_mask(paint.opacity, tile)
    note = f"departure, natural logarithms: {departure.note}; opacity: {opacity.note}"
    return mosaic([("departure", departure), ("opacity", opacity)], note, columns=2)
