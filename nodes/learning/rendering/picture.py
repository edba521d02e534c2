"""A random person, photographed: an example."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from graphface.nodes.learning.rendering.denoise import denoised
from graphface.nodes.learning.rendering.example import BARE_SKIN, EYES_AND_TEETH, FORMAT, REST, Example
from graphface.nodes.learning.rendering.film import developed
from graphface.nodes.learning.rendering.framing import framed, turned
from graphface.nodes.learning.rendering.head_model import EYE, SKIN, TEETH, HeadModel
from graphface.nodes.learning.rendering.lights import Lights, random_lights
from graphface.nodes.learning.rendering.person import dressed, expressed, random_shape
from graphface.nodes.learning.rendering.scene import View, path_traced
from graphface.nodes.rasterize import rasterized
from graphface.nodes.render.depth_buffer import disc, visible_share
from graphface.nodes.types import FloatArray, Mesh, Surface

_SHADOW_POINTS, _SHADOW_TEXELS, _SHADOW_BIAS = 4, 400, 0.012
"""Of the depth buffers behind `visibility`; the bias in inter-ocular distances."""


def make_example(model: HeadModel, seed: int, *, size: int, samples: int) -> Example:
    """The example of a seed: a random head, pose, light and camera.

    Args:
        size: pixels along a side. samples: paths through a pixel.

    Raises:
        UsageError: mitsuba is not installed.
    """
    random = np.random.default_rng(seed)
    shape = random_shape(model, random)
    expression = _expression(model.names, random) if random.uniform() < 0.7 else {}
    person = dressed(model, shape, random)
    body, landmarks, pose = turned(*expressed(model, person, expression), random)
    view = framed(landmarks, random, size)
    lights = random_lights(random)
    wall = tuple(random.uniform(0.03, 0.75, 3) if random.random() < 0.3 else np.full(3, random.uniform(0.02, 0.8)))
    noisy = path_traced(body, view, lights, wall, samples=samples, seed=seed % 2**31)

    eyes = float(np.linalg.norm(landmarks[36] - landmarks[45]))
    mesh = view.mesh(body.vertices, body.triangles, body.normals, eyes)
    surface = rasterized(mesh, (size, size), smoothing=0.0)
    labels = _labels(surface, mesh, model.part, person.coat.hair)
    visibility = _visibility(mesh, surface, view, lights)
    albedo = interpolated(body.albedo, surface, mesh)
    radiance = denoised(noisy, albedo, surface.normals, visibility, surface.coverage > 0)
    facts = {
        "format": FORMAT,
        "seed": seed,
        "samples": samples,
        "lights": lights.as_json(),
        "pose": pose,
        "expression": expression,
        "focal": view.focal,
        "distance": view.distance,
        "interocular": mesh.interocular,
    }
    return Example(
        photo=developed(radiance, labels == BARE_SKIN, random),
        normals=np.round(surface.normals * 127).astype(np.int8),
        depth=(surface.depth / mesh.interocular).astype(np.float16),
        labels=labels,
        visibility=visibility,
        facts=facts,
    )


def _expression(names: tuple[str, ...], random: np.random.Generator) -> dict[str, float]:
    """A few weights, most of them the same on both sides."""
    weights: dict[str, float] = {}
    for _ in range(random.integers(1, 5)):
        name = str(random.choice(names))
        weight = float(random.uniform(0.1, 0.9)) * (0.5 if name == "jawOpen" else 1.0)
        weights[name] = weight
        if name[-2:] in ("_L", "_R") and random.random() < 0.8:
            weights[name[:-1] + ("R" if name.endswith("L") else "L")] = weight
    return weights


def interpolated(values: NDArray[np.float64], surface: Surface, mesh: Mesh) -> FloatArray:
    """Values at vertices (M, 3) on the picture, 0 beyond the head."""
    found = np.zeros((*surface.coverage.shape, values.shape[1]), np.float32)
    covered = surface.coverage > 0
    corners = mesh.triangles[surface.triangle[covered]]
    found[covered] = (values[corners] * surface.barycentric[covered][..., None]).sum(axis=1)
    return found


def _labels(surface: Surface, mesh: Mesh, part: NDArray[np.int8], hair: NDArray[np.float64]) -> NDArray[np.uint8]:
    corners = mesh.triangles[np.maximum(surface.triangle, 0)]
    kinds = part[corners[..., 0]]
    hairy = (hair[corners] * surface.barycentric).sum(axis=2)
    labels = np.full(kinds.shape, REST, np.uint8)
    labels[(kinds == SKIN) & (hairy < 0.5)] = BARE_SKIN
    labels[(kinds == EYE) | (kinds == TEETH)] = EYES_AND_TEETH
    labels[surface.triangle < 0] = REST
    return labels


def _visibility(mesh: Mesh, surface: Surface, view: View, lights: Lights) -> NDArray[np.uint8]:
    """255 times the share of the first lamp that reaches each pixel, by depth buffers of the true head."""
    shape = surface.coverage.shape
    visibility = np.zeros(shape, np.uint8)
    covered = surface.coverage > 0
    lamp, unit = lights.lamps[0], mesh.interocular
    middle = view.origin - view.axes[2] * view.distance
    towards = view.axes @ np.asarray(lamp.direction)
    place = view.seen((middle + np.asarray(lamp.direction) * lamp.distance)[None])[0] / unit
    spread = disc(towards.astype(np.float32), lamp.half_size * view.pixels_per_unit / unit * 1.13, _SHADOW_POINTS)
    corners = mesh.triangles[surface.triangle[covered]]
    points: FloatArray = (mesh.vertices[corners] * surface.barycentric[covered][..., None]).sum(axis=1) / unit
    share = visible_share(
        np.ascontiguousarray(points, np.float32),
        surface.normals[covered],
        (place + spread).astype(np.float32),
        (mesh.vertices / np.float32(unit)).astype(np.float32),
        mesh.triangles,
        resolution=_SHADOW_TEXELS,
        bias=_SHADOW_BIAS,
    )
    visibility[covered] = np.round(share * 255)
    return visibility
