"""Figures that compare a result with the truth: operators `metrics.*`, which may be called on plain arrays too."""

from graphface.nodes.metrics.dssim import dssim
from graphface.nodes.metrics.iou import iou
from graphface.nodes.metrics.landmark_error import landmark_error
from graphface.nodes.metrics.light_angle import light_angle
from graphface.nodes.metrics.lmse import lmse
from graphface.nodes.metrics.ms_ssim import ms_ssim
from graphface.nodes.metrics.normal_angle import normal_angle
from graphface.nodes.metrics.psnr import psnr
from graphface.nodes.metrics.si_mse import si_mse
from graphface.nodes.metrics.si_psnr import si_psnr
from graphface.nodes.metrics.ssim import ssim
from graphface.nodes.metrics.whdr import whdr

__all__ = [
    "dssim",
    "iou",
    "landmark_error",
    "light_angle",
    "lmse",
    "ms_ssim",
    "normal_angle",
    "psnr",
    "si_mse",
    "si_psnr",
    "ssim",
    "whdr",
]
