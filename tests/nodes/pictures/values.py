"""A small value of every type that operators return, of a picture of 24 x 32 pixels."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import fields
from typing import Any

import numpy as np

from graphface.nodes.masks.features import PixelFeatures
from graphface.nodes.masks.hair import Hair
from graphface.nodes.masks.label_weights import LabelWeights, shipped_weights
from graphface.nodes.masks.window import Window
from graphface.nodes.morphable.builtin import builtin_model
from graphface.nodes.types import (
    BareSkin,
    Camera,
    Correspondence,
    DetailMap,
    DirectionalLight,
    Environment,
    Features,
    FileFormat,
    FitRecord,
    HarmonicLight,
    HeadMasks,
    Image,
    Intrinsic,
    Judgement,
    Judgements,
    Landmarks,
    Lighting,
    LightingFit,
    Mesh,
    Paint,
    Pins,
    PointLight,
    RefinedSurface,
    Regions,
    Representation,
    Samples,
    Scene,
    Segmentation,
    Shadows,
    SpotLight,
    Surface,
    Surroundings,
    Texture,
    TexturedMesh,
)

HEIGHT, WIDTH = 24, 32


def rng() -> np.random.Generator:
    return np.random.default_rng(5)


def unit(*shape: int) -> Any:
    """float32 in 0..1."""
    return rng().random(shape or (HEIGHT, WIDTH), dtype=np.float32)


def colors(height: int = HEIGHT, width: int = WIDTH) -> Any:
    return unit(height, width, 3)


def normals() -> Any:
    vectors = colors() * 2 - 1
    vectors /= np.linalg.norm(vectors, axis=2, keepdims=True)
    vectors[:4] = 0
    return vectors


def mesh() -> Mesh:
    x, y = np.meshgrid(np.arange(6.0), np.arange(6.0))
    vertices = np.stack([x.ravel(), y.ravel(), 0.2 * x.ravel() * y.ravel()], axis=1).astype(np.float32)
    corner = (np.arange(5)[:, None] * 6 + np.arange(5)).ravel()
    halves = [np.stack([corner, corner + 1, corner + 6], 1), np.stack([corner + 1, corner + 7, corner + 6], 1)]
    facing = np.tile(np.float32([0, 0, 1]), (36, 1))
    uv = np.stack([x.ravel(), y.ravel()], axis=1).astype(np.float32) / 5
    return Mesh(vertices, np.concatenate(halves).astype(np.int32), facing, Camera(3, (4, 20)), 10.0, uv=uv)


def surface() -> Surface:
    covered = (normals() != 0).any(axis=2)
    return Surface(
        normals(), unit() * covered, covered.astype(np.float32), np.where(covered, 0, -1).astype(np.int32), colors()
    )


def masks(kind: type) -> Any:
    return kind(**{field.name: unit() / len(fields(kind)) for field in fields(kind)})


def landmarks() -> Landmarks:
    points = unit(68, 3) * np.float32([WIDTH, HEIGHT, 1])
    return Landmarks(points, "ibug68", 0.9)


def fit() -> FitRecord:
    return FitRecord("mine", unit(5), unit(3), np.eye(3), 30.0, 0.0, 1.2, unit(68), unit(4), 17.0, True)


def surroundings() -> Surroundings:
    return Surroundings(unit(), 4, (1, 4, 2, 6), unit(3, 4), np.zeros((6, 8), np.intp), unit(6, 8), 1.0)


def samples() -> Samples:
    n = 20
    cells = np.arange(n)
    parts = unit(n, 3)
    return Samples(
        (HEIGHT, WIDTH), (6, 8), cells, cells, parts, parts, unit(n), unit(n), unit(n), cells, unit(n), unit(), "srgb"
    )


def scene() -> Scene:
    lights = (
        DirectionalLight(azimuth=-50, elevation=20),
        PointLight(azimuth=170, distance=2, kelvin=2700),
        SpotLight(azimuth=60, elevation=30, color=(0.3, 0.4, 1)),
        HarmonicLight(preset="left"),
    )
    return Scene(ambient=0.2, lights=lights)


def correspondence() -> Correspondence:
    places = unit(HEIGHT, WIDTH, 2) * np.float32([WIDTH, HEIGHT])
    return Correspondence(places, np.ones((HEIGHT, WIDTH), np.float32), unit(), (HEIGHT, WIDTH))


def representation() -> Representation:
    found = surface()
    maps = {"albedo": colors(), "shading": unit(), "estimated": unit(), "spread": unit()}
    return Representation(
        working=Image(colors()),
        landmarks=landmarks(),
        mesh=mesh(),
        surface=found,
        mask=unit(),
        labels=masks(Segmentation),
        head=mesh(),
        head_surface=found,
        head_mask=unit(),
        surroundings=surroundings(),
        light=Lighting(unit(9)),
        detail=DetailMap(colors() - 0.5),
        **maps,
    )


VALUES: dict[str, Callable[[], Any]] = {
    "Albedo": colors,
    "BareSkin": lambda: BareSkin(colors(), 0.03, 0.0, 1.0),
    "Camera": lambda: Camera(300.0, (200.0, 150.0), 0.001),
    "Correspondence": correspondence,
    "Depth": lambda: surface().depth,
    "Detail": lambda: colors() - 0.5,
    "DetailMap": lambda: DetailMap(colors() - 0.5, colors() * 2),
    "Direction": lambda: np.float32([0.6, 0, -0.8]),
    "Environment": lambda: Environment(unit(16, 32, 3) * 3),
    "FaceCoordinates": lambda: np.where(surface().coverage[..., None] > 0, colors()[..., :2], np.float32(-1)),
    "Features": lambda: masks(Features),
    "FileFormat": FileFormat,
    "FitRecord": fit,
    "Gain": lambda: colors() * 2,
    "Hair": lambda: masks(Hair),
    "HeadMasks": lambda: masks(HeadMasks),
    "Image": lambda: Image(colors(), unit()),
    "Intrinsic": lambda: Intrinsic(colors(), unit()),
    "Judgements": lambda: Judgements((Judgement((0.1, 0.1), (0.5, 0.9), "1"), Judgement((0.2, 0), (0.3, 1), "E"))),
    "LabelWeights": lambda: LabelWeights(shipped_weights()),
    "Landmarks": landmarks,
    "Lighting": lambda: Lighting(unit(4, 3)),
    "LightingFit": lambda: LightingFit(Lighting(unit(9)), unit() - 0.5, 12.0, np.float32([0, 0.6, 0.8])),
    "Mask": unit,
    "Mesh": mesh,
    "MorphableModel": builtin_model,
    "Normals": normals,
    "Paint": lambda: Paint(unit(), colors() - 0.5, unit(3)),
    "Pins": lambda: Pins(np.float32([[1, 2, 20, 10], [5, 5, 6, 6]])),
    "PixelFeatures": lambda: PixelFeatures(Window(0, 24, 0, 32, 12, 16), unit(12, 16, 11)),
    "RefinedSurface": lambda: RefinedSurface(surface(), unit()),
    "Regions": lambda: masks(Regions),
    "Representation": representation,
    "Samples": samples,
    "Scene": scene,
    "Segmentation": lambda: masks(Segmentation),
    "Shading": unit,
    "Shadows": lambda: Shadows((0, 2), unit(2, HEIGHT, WIDTH)),
    "Surface": surface,
    "Surroundings": surroundings,
    "Texture": lambda: Texture(Image(colors(16, 16)), unit(16, 16)),
    "TexturedMesh": lambda: TexturedMesh(mesh(), Texture(Image(colors(16, 16)), unit(16, 16))),
    "Visibility": lambda: unit(36),
    "Window": lambda: Window(0, 24, 0, 32, 12, 16),
}
"""From a type's name to one of its values."""

EXACT: dict[str, Callable[[Any], Any]] = {
    "Albedo": lambda v: v,
    "Depth": lambda v: v,
    "Detail": lambda v: v,
    "Environment": lambda v: v.radiance,
    "FaceCoordinates": lambda v: v,
    "Features": lambda v: np.stack([getattr(v, f.name) for f in fields(v)], axis=2),
    "Gain": lambda v: v,
    "HeadMasks": lambda v: np.stack([v.conservative, v.normal, v.aggressive], axis=2),
    "Image": lambda v: np.concatenate([v.pixels, v.alpha[..., None]], axis=2),
    "LightingFit": lambda v: v.residual,
    "Mask": lambda v: v,
    "Normals": lambda v: v,
    "RefinedSurface": lambda v: np.dstack([v.surface.normals, v.surface.depth, v.shadow]),
    "Regions": lambda v: np.stack([getattr(v, f.name) for f in fields(v)], axis=2),
    "Segmentation": lambda v: np.stack([v.face, v.hair, v.background], axis=2),
    "Shading": lambda v: v,
    "Surface": lambda v: np.concatenate([v.normals, v.depth[..., None]], axis=2),
    "Surroundings": lambda v: v.weight,
    "Texture": lambda v: np.concatenate([v.image.pixels, v.seen[..., None]], axis=2),
}
"""Of types with a value under each pixel: the array that the picture's data is sampled from."""
