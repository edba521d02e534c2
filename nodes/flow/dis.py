"""Dense inverse search."""

from __future__ import annotations

from typing import Any

from graphface.nodes.flow.refine import GreyPicture, flow_operator


@flow_operator("flow.dis", resolution=90)
def dis(source: GreyPicture, target: GreyPicture) -> Any:
    """Kroeger, Timofte, Dai, Van Gool, Fast Optical Flow using Dense Inverse Search, ECCV 2016."""
    import cv2

    return cv2.DISOpticalFlow_create(cv2.DISOPTICAL_FLOW_PRESET_MEDIUM).calc(source, target, None)  # type: ignore[attr-defined]
