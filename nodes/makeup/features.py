"""Soft masks of the parts of a face that makeup treats differently, drawn as polygons through FaceMesh's points."""

from __future__ import annotations

from typing import Annotated, Any

import numpy as np
from numpy.typing import NDArray
from pydantic import Field

from graphface import UsageError, node, warn
from graphface.nodes.blur import blurred
from graphface.nodes.bounding_box import Box
from graphface.nodes.face_outlines import BROWS, CHEEKS, EYES, LIDS, LIPS, MOUTH, NOSE
from graphface.nodes.types import Features, FloatArray, Image, Landmarks

_FRACTION_BITS = 4
"""Of the fixed-point coordinates that OpenCV draws with."""


@node("makeup.features")
def features(photo: Image, landmarks: Landmarks, *, softness: Annotated[float, Field(ge=0, le=1)] = 0.02) -> Features:
    """Masks of eyes, mouth, lips, lids, brows, nose and cheeks.

    Args:
        photo: gives the size; its pixels are not read. landmarks: scheme "facemesh468".
        softness: sigma of the Gaussian that blurs the outlines, in inter-ocular distances; broad parts (cheeks, lids,
            nose) get a multiple of it.

    Raises:
        UsageError: the landmarks follow another scheme.
    """
    if landmarks.scheme != "facemesh468":
        raise UsageError(f"makeup.features needs landmarks of the scheme 'facemesh468', got {landmarks.scheme!r}")
    if not np.isfinite(landmarks.points).all():
        warn("makeup.features: some landmarks are not finite; they are left out of the outlines")
    canvas = _Canvas(photo, landmarks, softness * landmarks.interocular)
    eyes, mouth, lips = canvas.drawn(EYES, 0.7), canvas.drawn((MOUTH,), 0.7), canvas.drawn((LIPS,), 1)
    return Features(
        eyes=eyes,
        mouth=mouth,
        lips=np.maximum(lips - mouth, 0),
        around=np.clip(canvas.drawn((LIPS,), 1, grow=0.12) - lips, 0, 1),
        lids=np.maximum(canvas.drawn(LIDS, 3, hull=True) - eyes, 0),
        brows=canvas.drawn(BROWS, 2, hull=True),
        nose=canvas.drawn((NOSE,), 2),
        cheeks=canvas.drawn(CHEEKS, 6, hull=True),
    )


class _Canvas:
    """Draws soft polygons, each into its own bounding box."""

    def __init__(self, photo: Image, landmarks: Landmarks, softness: float) -> None:
        self.shape = (photo.height, photo.width)
        self.points = landmarks.points[:, :2].astype(np.float64)
        self.softness = softness
        self.unit = landmarks.interocular

    def drawn(
        self, outlines: tuple[tuple[int, ...], ...], blur: float, hull: bool = False, grow: float = 0
    ) -> FloatArray:
        """The union of polygons through the points of these indices, or of their convex hulls, blurred.

        Args:
            blur: sigma of the Gaussian as a multiple of the softness.
            grow: width of a dilation before the blur, in inter-ocular distances.
        """
        import cv2

        mask = np.zeros(self.shape, np.float32)
        sigma = max(blur * self.softness, 0.3)
        for outline in outlines:
            corners = self.points[list(outline)]
            corners = corners[np.isfinite(corners).all(axis=1)]
            box = self._box(corners, margin=3 * sigma + grow * self.unit + 2)
            if box is None:
                continue
            rows, columns = box
            origin = np.array([columns.start, rows.start])
            polygon: NDArray[Any] = np.round((corners - origin) * (1 << _FRACTION_BITS)).astype(np.int32)
            if hull:
                polygon = cv2.convexHull(polygon)[:, 0]
            drawn = np.zeros((rows.stop - rows.start, columns.stop - columns.start), np.uint8)
            cv2.fillPoly(drawn, [polygon], 255, cv2.LINE_AA, _FRACTION_BITS)
            if grow > 0:
                # Dilation by the distance transform: the cost of `dilate` grows with the square of the width.
                distance = cv2.distanceTransform(255 - drawn, cv2.DIST_L2, cv2.DIST_MASK_PRECISE)
                drawn = np.where(distance <= grow * self.unit, np.uint8(255), np.uint8(0))
            soft = blurred(drawn.astype(np.float32) / np.float32(255), sigma)
            mask[rows, columns] = np.maximum(mask[rows, columns], soft)
        return mask

    def _box(self, corners: NDArray[np.float64], margin: float) -> Box | None:
        """The part of the picture around the corners; None without a polygon, or outside of the picture."""
        if len(corners) < 3:
            return None
        height, width = self.shape
        x0, y0 = np.floor(np.clip(corners.min(axis=0) - margin, 0, (width, height))).astype(int)
        x1, y1 = np.ceil(np.clip(corners.max(axis=0) + margin + 1, 0, (width, height))).astype(int)
        return (slice(int(y0), int(y1)), slice(int(x0), int(x1))) if x1 > x0 and y1 > y0 else None
