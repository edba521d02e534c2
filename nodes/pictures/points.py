"""Points on the photo: landmarks, pins, judgements, vertices that the camera sees."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import cv2
import numpy as np
from numpy.typing import NDArray

from graphface.nodes.landmark_schemes import BROWS, EYES, IBUG68_IN_FACEMESH468, INNER_LIPS, JAW, NOSE, OUTER_LIPS
from graphface.nodes.pictures.photo import Pixels, backdrop, bytes_of
from graphface.nodes.types import Image, Judgements, Landmarks, Mesh, Pins, Visibility
from graphface.pictures.card import draw_text
from graphface.pictures.plots import draw_curve
from graphface.values.picture import Picture, View

_DOT, _LINE = (255, 215, 60), (90, 230, 150)
_SIDE = 480
"""Longer side of a frame without a photo, where the view does not say."""
_CONTOURS = (
    (JAW, False),
    (BROWS[:5], False),
    (BROWS[5:], False),
    (NOSE[:4], False),
    (NOSE[4:], False),
    (EYES[:6], True),
    (EYES[6:], True),
    (OUTER_LIPS, True),
    (INNER_LIPS, True),
)


@dataclass(frozen=True)
class Frame:
    """A picture to draw on, and how positions in the photo become positions in it: scale * (p + 1/2) + shift - 1/2."""

    pixels: Pixels
    scale: NDArray[np.float64]
    shift: NDArray[np.float64]

    def places(self, points: NDArray[Any]) -> NDArray[np.float64]:
        """Positions (..., 2) in the frame; what is far outside is brought near its edge, as OpenCV's numbers end."""
        at = (np.asarray(points, np.float64) + 0.5) * self.scale + self.shift - 0.5
        return np.clip(np.nan_to_num(at, nan=-1e4), -1e4, 1e4)

    def dot(self, at: NDArray[np.float64], color: Any, radius: float) -> None:
        center = (round(float(at[0]) * 16), round(float(at[1]) * 16))
        cv2.circle(self.pixels, center, max(8, round(radius * 16)), color, -1, cv2.LINE_AA, shift=4)

    def line(self, at: NDArray[np.float64], color: Any, *, closed: bool = False, thickness: int = 1) -> None:
        lines = [np.round(at * 16).astype(np.int32)]
        cv2.polylines(self.pixels, lines, closed, color, thickness, cv2.LINE_AA, shift=4)

    @property
    def unit(self) -> float:
        """A dot's radius, or the width of a line."""
        return float(max(self.pixels.shape[:2]) / 400)


def frame_for(view: View, points: NDArray[Any], *, dark: bool = False) -> Frame:
    """The photo that points lie on; where there is none, grey, with the points in the middle.

    Args:
        points: (n, 2) in pixels. dark: the photo as a backdrop rather than as it is.
    """
    photo = view.above(Image)
    if photo is not None and 0 not in photo.pixels.shape:
        seen = view.sampled(photo.pixels)
        full = photo.pixels.shape
        under = backdrop(view, full, seen.shape) if dark else bytes_of(photo, seen)
        scale = np.array([seen.shape[1] / full[1], seen.shape[0] / full[0]])
        return Frame(np.ascontiguousarray(under), scale, np.zeros(2))
    finite = points[np.isfinite(points).all(axis=1)]
    low, high = (finite.min(axis=0), finite.max(axis=0)) if len(finite) else (np.zeros(2), np.ones(2))
    reach = max(float((high - low).max()) * 1.15, 1e-6)
    side = view.size or _SIDE
    middle = (low + high) / 2
    shape = np.maximum(np.ceil((high - low + 0.15 * reach) / reach * side), side // 3).astype(int)
    scale = np.full(2, side / reach)
    return Frame(np.full((shape[1], shape[0], 3), 64, np.uint8), scale, shape / 2 - (middle + 0.5) * scale)


def draw_landmarks(landmarks: Landmarks, view: View) -> Picture:
    """The points on the photo, the contours of the features as lines."""
    frame = frame_for(view, landmarks.points[:, :2])
    places, known = frame.places(landmarks.points[:, :2]), np.all(np.isfinite(landmarks.points[:, :2]), axis=1)
    thickness = max(1, round(frame.unit))
    for contour, closed in _CONTOURS:
        numbers = _in_scheme(contour, landmarks.scheme)
        if len(numbers) and known[numbers].all():
            frame.line(places[numbers], _LINE, closed=closed, thickness=thickness)
    extent = float(np.ptp(places[known], axis=0).max()) if known.any() else 0.0
    for at in places[known]:
        frame.dot(at, _DOT, min(frame.unit * 0.8, extent / 200))
    note = f"{landmarks.scheme}, score {landmarks.score:.3g}, {landmarks.faces} faces in the photo"
    missing = int((~known).sum())
    return Picture(frame.pixels, note + (f"; {missing} points are unknown" if missing else ""))


def _in_scheme(contour: tuple[int, ...], scheme: str) -> NDArray[np.intp]:
    """A contour of FaceMesh's points by the numbers of a scheme."""
    if scheme == "facemesh468":
        return np.array(contour)
    if scheme != "ibug68":
        return np.zeros(0, np.intp)
    places = {int(point): place for place, point in enumerate(IBUG68_IN_FACEMESH468)}
    return np.array([places[point] for point in contour])


def draw_visibility(visibility: Visibility, view: View) -> Picture:
    """Every vertex of the mesh as a dot, green where the camera sees it, red where not."""
    mesh = view.above(Mesh)
    if mesh is None or len(mesh.vertices) != len(visibility):
        return draw_curve(visibility, view)
    points = mesh.camera.project(mesh.vertices.astype(np.float64))
    frame = frame_for(view, points, dark=True)
    share = np.clip(np.nan_to_num(visibility), 0, 1)
    places = frame.places(points)
    for index in np.argsort(mesh.vertices[:, 2]):
        color = (250 - 230 * float(share[index]), 30 + 210 * float(share[index]), 60)
        frame.dot(places[index], color, frame.unit * 0.8)
    return Picture(frame.pixels, f"green: seen, red: not; {(visibility > 0.5).mean():.0%} of the vertices are seen")


def draw_pins(pins: Pins, view: View) -> Picture:
    """Each pin as an arrow from its place in the input to that in the reference."""
    if not len(pins.points):
        return draw_text("no pins", view)
    frame = frame_for(view, pins.points.reshape(-1, 2), dark=True)
    for start, end in zip(frame.places(pins.points[:, :2]), frame.places(pins.points[:, 2:]), strict=True):
        tip = (round(end[0]), round(end[1]))
        cv2.arrowedLine(frame.pixels, (round(start[0]), round(start[1])), tip, _LINE, 1, cv2.LINE_AA, tipLength=0.1)
        frame.dot(start, _DOT, 1.5 * frame.unit)
    return Picture(frame.pixels, f"{len(pins.points)} pins, from the input (dot) to the reference (arrow)")


def draw_judgements(judgements: Judgements, view: View) -> Picture:
    """A line for each comparison, with a dot at the point that is darker."""
    if not judgements.pairs:
        return draw_text("no judgements", view)
    photo = view.above(Image)
    height, width = (photo.height, photo.width) if photo is not None else (1, 1)
    ends = np.array([[pair.first, pair.second] for pair in judgements.pairs]) * (width, height)
    if photo is None:
        ends *= view.size or _SIDE
    frame = frame_for(view, ends.reshape(-1, 2), dark=True)
    for pair, places in zip(judgements.pairs, frame.places(ends), strict=True):
        equal = pair.darker == "E"
        frame.line(places, (140, 170, 255) if equal else _LINE, thickness=max(1, round(frame.unit)))
        if not equal:
            frame.dot(places[int(pair.darker) - 1], _DOT, 1.5 * frame.unit)
    note = f"{len(judgements.pairs)} comparisons: a dot at the darker point, blue lines: both are equal"
    return Picture(frame.pixels, note)
