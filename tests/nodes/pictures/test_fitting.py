"""Cameras and fits."""

from __future__ import annotations

from dataclasses import replace

from values import fit

from graphface.nodes.pictures.fitting import draw_camera, draw_fit_record
from graphface.nodes.types import Camera
from graphface.values.picture import View


def test_camera():
    """Rays meet in a near camera and are parallel to a far one."""
    near, far = (draw_camera(Camera(300, (10, 20), n), View(200)).pixels for n in (0.001, 0.0))
    assert (near != far).any()


def test_fit_record():
    """The note says how good the fit is."""
    assert draw_fit_record(fit(), View(384)).note == "mine: residual 1.2 px, converged"
    assert draw_fit_record(replace(fit(), converged=False), View(384)).note.endswith("not converged")
