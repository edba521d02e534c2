"""A head before a wall, path-traced with mitsuba (Jakob et al., Mitsuba 3), which only this module needs."""

from __future__ import annotations

import os
import tempfile
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from graphface import UsageError
from graphface.nodes.learning.rendering.lights import Lamp, Lights
from graphface.nodes.types import Camera, FloatArray, Mesh

_WALL = 60.0
"""Centimetres behind the head."""


@dataclass(frozen=True)
class View:
    """A pinhole camera: `origin` and `axes` (right, up, back as rows) in the head's frame, centimetres.

    Attributes:
        focal: in pixels. size: of the picture, which is square, pixels. distance: along `back` to the head's middle.
    """

    origin: NDArray[np.float64]
    axes: NDArray[np.float64]
    focal: float
    size: int
    distance: float

    @property
    def pixels_per_unit(self) -> float:
        return self.focal / self.distance

    def seen(self, points: NDArray[np.float64]) -> NDArray[np.float64]:
        """Points (n, 3) in the camera frame of `Mesh`: pixels, origin at the head's middle."""
        own = (points - self.origin) @ self.axes.T
        own[:, 2] += self.distance
        return np.asarray(own * self.pixels_per_unit)

    def mesh(
        self, vertices: NDArray[np.float64], triangles: NDArray[np.int32], normals: NDArray[np.float64], eyes: float
    ) -> Mesh:
        """The head as the rasterizer takes it; `eyes` centimetres between the outer eye corners."""
        middle = (self.size - 1) / 2
        return Mesh(
            vertices=self.seen(vertices).astype(np.float32),
            triangles=triangles,
            normals=(normals @ self.axes.T).astype(np.float32),
            camera=Camera(1.0, (middle, middle), 1 / self.focal),
            interocular=eyes * self.pixels_per_unit,
        )


@dataclass(frozen=True)
class Body:
    """What is rendered: vertices, normals (M, 3), triangles, linear albedo (M, 3), roughness (M,), specular."""

    vertices: NDArray[np.float64]
    normals: NDArray[np.float64]
    triangles: NDArray[np.int32]
    albedo: NDArray[np.float64]
    roughness: NDArray[np.float64]
    specular: float


def path_traced(
    body: Body, view: View, lights: Lights, wall: tuple[float, ...], *, samples: int, seed: int
) -> FloatArray:
    """Linear radiance, float32 H x W x 3: depth 3, so light that one surface throws on another is in it.

    Raises:
        UsageError: mitsuba is not installed.
    """
    mi = mitsuba()
    handle, name = tempfile.mkstemp(suffix=".ply")
    os.close(handle)
    try:
        _write_ply(Path(name), body)
        mesh = mi.load_dict({"type": "ply", "filename": name, "face_normals": False, "bsdf": _skin(body.specular)})
        mesh.add_attribute("vertex_roughness", 1, body.roughness.astype(np.float32).tolist())
    finally:
        Path(name).unlink()
    middle = view.origin - view.axes[2] * view.distance
    scene = {"type": "scene", "integrator": {"type": "path", "max_depth": 3}, "head": mesh}
    scene["sensor"] = _sensor(mi, view, samples)
    scene["ambient"] = {"type": "constant", "radiance": _rgb(lights.ambient)}
    behind = mi.ScalarTransform4f().translate([*map(float, middle[:2]), float(middle[2]) - _WALL])
    scene["wall"] = {
        "type": "rectangle",
        "to_world": behind @ mi.ScalarTransform4f().scale([200, 200, 1]),
        "bsdf": {"type": "diffuse", "reflectance": _rgb(wall)},
    }
    for index, lamp in enumerate(lights.lamps):
        scene[f"lamp{index}"] = _rectangle(mi, lamp, middle)
    radiance = np.array(mi.render(mi.load_dict(scene), seed=seed), np.float32)[..., :3]
    return np.nan_to_num(radiance, nan=0.0, posinf=0.0)  # paths along the surface may end in no number


@cache
def mitsuba() -> Any:
    """mitsuba in the variant that needs neither LLVM nor a GPU, on one thread.

    Raises:
        UsageError: it is not installed.
    """
    try:
        import drjit
        import mitsuba
    except ImportError:
        raise UsageError("rendering needs mitsuba: pip install 'graphface[truth]'") from None
    mitsuba.set_variant("scalar_rgb")
    mitsuba.set_log_level(mitsuba.LogLevel.Error)
    drjit.set_thread_count(0)
    return mitsuba


def _skin(specular: float) -> dict[str, Any]:
    return {
        "type": "principled",
        "base_color": {"type": "mesh_attribute", "name": "vertex_color"},
        "roughness": {"type": "mesh_attribute", "name": "vertex_roughness"},
        "specular": specular,
    }


def _sensor(mi: Any, view: View, samples: int) -> dict[str, Any]:
    origin, ahead, up = view.origin, view.origin - view.axes[2], view.axes[1]
    return {
        "type": "perspective",
        "fov": float(2 * np.degrees(np.arctan(view.size / 2 / view.focal))),
        "to_world": mi.ScalarTransform4f().look_at(origin=origin.tolist(), target=ahead.tolist(), up=up.tolist()),
        "film": {
            "type": "hdrfilm",
            "width": view.size,
            "height": view.size,
            "rfilter": {"type": "gaussian"},
            "pixel_format": "rgb",
        },
        "sampler": {"type": "independent", "sample_count": samples},
    }


def _rectangle(mi: Any, lamp: Lamp, middle: NDArray[np.float64]) -> dict[str, Any]:
    towards = np.asarray(lamp.direction)
    up = [0.0, 1.0, 0.0] if abs(towards[1]) < 0.9 else [1.0, 0.0, 0.0]
    place = middle + towards * lamp.distance
    look = mi.ScalarTransform4f().look_at(origin=place.tolist(), target=middle.tolist(), up=up)
    return {
        "type": "rectangle",
        "to_world": look @ mi.ScalarTransform4f().scale([lamp.half_size, lamp.half_size, 1]),
        "emitter": {"type": "area", "radiance": _rgb(lamp.radiance)},
    }


def _rgb(values: tuple[float, ...]) -> dict[str, Any]:
    return {"type": "rgb", "value": [float(value) for value in values]}


def _write_ply(path: Path, body: Body) -> None:
    fields = [(name, "<f4") for name in ("x", "y", "z", "nx", "ny", "nz", "r", "g", "b")]
    vertices = np.concatenate([body.vertices, body.normals, body.albedo], axis=1).astype("<f4")
    faces = np.empty(len(body.triangles), [("count", "u1"), ("corners", "<i4", 3)])
    faces["count"], faces["corners"] = 3, body.triangles
    header = ["ply", "format binary_little_endian 1.0", f"element vertex {len(vertices)}"]
    header += [f"property float {name}" for name, _ in fields]
    header += [f"element face {len(faces)}", "property list uchar int vertex_indices", "end_header", ""]
    path.write_bytes("\n".join(header).encode() + vertices.tobytes() + faces.tobytes())
