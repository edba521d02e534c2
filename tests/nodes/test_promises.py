"""The shipped operators keep the promises that memoization and threads rely on (`graphface.testing`)."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

import numpy as np
import pytest

from graphface.nodes.types import Camera, Image, Landmarks, Lighting, Mesh
from graphface.registry import default_registry
from graphface.testing import check_node

SIZE = 32


def _photo() -> Image:
    rng = np.random.default_rng(3)
    return Image(rng.uniform(0.1, 0.9, (SIZE, SIZE, 3)).astype(np.float32))


def _dome() -> np.ndarray:
    """Normals of a half sphere that fills the picture, (SIZE, SIZE, 3)."""
    y, x = (np.mgrid[:SIZE, :SIZE] + 0.5) / SIZE * 2 - 1
    z = np.sqrt(np.maximum(1 - x**2 - y**2, 0))
    normals = np.stack([x, -y, z], axis=2) * (x**2 + y**2 < 1)[..., None]
    return (normals / np.maximum(np.linalg.norm(normals, axis=2, keepdims=True), 1e-6)).astype(np.float32)


def _mesh() -> Mesh:
    """Two triangles that face the viewer, in the middle of the picture."""
    vertices = np.array([[-8, -8, 0], [8, -8, 0], [8, 8, 0], [-8, 8, 0]], np.float32)
    triangles = np.array([[0, 1, 2], [0, 2, 3]], np.int32)
    normals = np.tile(np.array([0, 0, 1], np.float32), (4, 1))
    return Mesh(vertices, triangles, normals, Camera(center=(SIZE / 2, SIZE / 2)), interocular=10.0)


@dataclass
class Case:
    """Inputs of one operator, as a function so that nothing is made while tests are collected."""

    operator: str
    inputs: Callable[[], tuple[Any, ...]]
    parameters: dict[str, Any] = field(default_factory=dict)


def _disc() -> np.ndarray:
    return (_dome()[..., 2] > 0.3).astype(np.float32)


def _grey() -> np.ndarray:
    return _photo().pixels.mean(axis=2)


def _surface() -> Any:
    return default_registry().operator("surface.rasterize").function(_mesh(), _photo())


def _points() -> Landmarks:
    points = np.random.default_rng(5).uniform(8, 24, (468, 3)).astype(np.float32)
    return Landmarks(points, "facemesh468")


def _surroundings() -> Any:
    return default_registry().operator("render.surroundings").function(_disc(), _surface(), _points())


CASES = [
    Case("image.encode", lambda: (_photo(),), {"encoding": "linear"}),
    Case("image.resize", lambda: (_photo(),), {"long_side": 20}),
    Case("intrinsic.intensity", lambda: (_photo(),)),
    Case("sh.fit", lambda: (_grey(), _dome(), _disc())),
    Case("sh.render", lambda: (Lighting(np.array([2, 0.1, 0.5, 0.2], np.float32)), _dome())),
    Case("detail.additive", lambda: (_photo(), _photo().pixels, _grey())),
    Case("detail.multiplicative", lambda: (_photo(), _photo().pixels, _grey())),
    Case("detail.none", lambda: (_photo(), _photo().pixels, _grey())),
    Case("masks.face", lambda: (_surface(), _points())),
    Case("render.samples", lambda: (_surface(), _grey(), _disc(), _photo(), _mesh())),
    Case("render.surroundings", lambda: (_disc(), _surface(), _points())),
    Case("render.spread", lambda: (_grey(), _surroundings())),
    Case("surface.rasterize", lambda: (_mesh(), _photo())),
]


@pytest.mark.filterwarnings("ignore::graphface.GraphfaceWarning")
@pytest.mark.parametrize("case", CASES, ids=lambda case: case.operator)
def test_promises(case: Case) -> None:
    """Pure, deterministic, of the declared type, finite, and not breaking down over NaN."""
    check_node(default_registry().operator(case.operator).function, *case.inputs(), **case.parameters)


def test_landmarks_given() -> None:
    """Points that were given pass through unchanged."""
    points = np.random.default_rng(0).uniform(4, 28, (68, 3)).astype(np.float32)
    given = Landmarks(points, "ibug68")
    out = check_node(default_registry().operator("landmarks.given").function, _photo(), given)
    assert out.scheme == "ibug68"
