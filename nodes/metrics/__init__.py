"""Figures: plain functions on arrays here, the same as operators `metrics.*` in `operators`."""

from graphface.nodes.metrics.geometry import direction_angle, iou, landmark_error, mean_angle
from graphface.nodes.metrics.judgements import whdr
from graphface.nodes.metrics.pictures import lmse, ms_ssim, psnr, si_mse, si_psnr, ssim
from graphface.nodes.types import Judgement

__all__ = [
    "Judgement",
    "direction_angle",
    "iou",
    "landmark_error",
    "lmse",
    "mean_angle",
    "ms_ssim",
    "psnr",
    "si_mse",
    "si_psnr",
    "ssim",
    "whdr",
]
