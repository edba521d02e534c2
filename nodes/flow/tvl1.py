"""Total variation with an L1 data term."""

from __future__ import annotations

from typing import Any

from graphface.nodes.flow.refine import GreyPicture, flow_operator


@flow_operator("flow.tvl1", resolution=60)
def tvl1(source: GreyPicture, target: GreyPicture) -> Any:
    """Zach, Pock, Bischof, A Duality Based Approach for Realtime TV-L1 Optical Flow, DAGM 2007."""
    import cv2

    return cv2.optflow.DualTVL1OpticalFlow_create().calc(source, target, None)  # type: ignore[attr-defined]
