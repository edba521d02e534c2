"""DeepFlow, in the variational form that OpenCV has, without descriptor matching."""

from __future__ import annotations

from typing import Any

from graphface.nodes.flow.refine import GreyPicture, flow_operator


@flow_operator("flow.deepflow", resolution=60)
def deepflow(source: GreyPicture, target: GreyPicture) -> Any:
    """Weinzaepfel, Revaud, Harchaoui, Schmid, DeepFlow: Large Displacement Optical Flow with Deep Matching, 2013."""
    import cv2

    return cv2.optflow.createOptFlow_DeepFlow().calc(source, target, None)  # type: ignore[call-overload]
