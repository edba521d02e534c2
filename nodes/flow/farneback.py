"""Polynomial expansion."""

from __future__ import annotations

from typing import Any

from graphface.nodes.flow.refine import GreyPicture, flow_operator


@flow_operator("flow.farneback", resolution=100)
def farneback(source: GreyPicture, target: GreyPicture) -> Any:
    """Farnebäck, Two-Frame Motion Estimation Based on Polynomial Expansion, SCIA 2003."""
    import cv2

    return cv2.calcOpticalFlowFarneback(source, target, None, 0.5, 4, 25, 5, 7, 1.5, 0)  # type: ignore[call-overload]
