"""A camera, and how well a face model was fitted."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray
from PIL import Image, ImageDraw

from graphface.nodes.types import Camera, FitRecord
from graphface.pictures.card import draw_text
from graphface.pictures.grid import draw_grid
from graphface.pictures.plots import draw_curve
from graphface.pictures.text import FAINT, INK, PAPER, write
from graphface.values.picture import Picture, View

_SIDE = 360


def draw_camera(camera: Camera, view: View) -> Picture:
    """The rays from the face to the camera, seen from the side, and the numbers."""
    side = max(64, min(view.size or _SIDE, 720))
    letters = max(8, side // 20)
    canvas = Image.new("RGB", (side, side * 3 // 4), PAPER)
    pen = ImageDraw.Draw(canvas)
    middle, radius = side * 0.28, side * 0.1
    face, eye = side * 0.16, side * 0.9
    pen.ellipse((face - radius * 0.8, middle - radius, face + radius * 0.8, middle + radius), (190, 178, 168))
    near = camera.nearness > 0
    for shift in (-1.0, -0.5, 0.0, 0.5, 1.0):
        end = middle if near else middle + shift * radius
        pen.line((face, middle + shift * radius, eye, end), FAINT)
    pen.rectangle((eye, middle - radius / 2, eye + radius / 2, middle + radius / 2), INK)
    distance = f"distance {1 / camera.nearness:.4g} units" if near else "infinitely far: parallel rays"
    x, y = camera.center
    lines = (distance, f"scale {camera.scale:.5g} px per unit", f"center ({x:.5g}, {y:.5g}) px")
    for row, line in enumerate(lines):
        write(pen, (side * 0.05, side * 0.48 + row * letters * 1.5), line, letters, width=side * 0.9)
    return Picture(np.asarray(canvas), "a unit is a pixel at the face's depth where the scale is 1")


def draw_fit_record(fit: FitRecord, view: View) -> Picture:
    """Coefficients, errors of the landmarks, and how the cost fell."""
    rotation = np.asarray(fit.rotation, np.float64)
    words = [
        fit.model,
        f"residual {fit.residual:.3g} px",
        "converged" if fit.converged else "not converged",
        f"scale {fit.scale:.4g} px",
        f"distance {fit.distance:.3g}" if fit.distance else "weak perspective",
        f"condition {fit.condition:.3g}",
    ]
    if rotation.shape == (3, 3):
        yaw = np.degrees(np.arctan2(rotation[0, 2], rotation[2, 2]))
        pitch = np.degrees(np.arcsin(np.clip(rotation[1, 2], -1, 1)))
        words.insert(1, f"yaw {yaw:.0f}, pitch {pitch:.0f} degrees")
    curves = {
        "identity, deviations": fit.identity,
        "expression, deviations": fit.expression,
        "errors, px": fit.errors,
        "cost": fit.costs,
    }
    cells = [("fit", lambda inner: draw_text("\n".join(words), inner))]
    cells += [(name, _curve(values)) for name, values in curves.items() if len(values)]
    note = f"{fit.model}: residual {fit.residual:.3g} px, {'converged' if fit.converged else 'not converged'}"
    return Picture(draw_grid(cells, view, columns=2).pixels, note)


def _curve(values: NDArray[Any]) -> Callable[[View], Picture]:
    return lambda view: draw_curve(values, view)
