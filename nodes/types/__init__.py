"""The values that travel between face operators; they read and write no files.

Maps (masks, normals, depth, albedo, shading, detail) are float32 arrays whose meaning is their type. Values of several
parts are frozen dataclasses. The conventions below hold for every operator:

- pixels: x to the right, y down, integer coordinates at pixel centres;
- camera frame: right-handed, x to the right, y up, z towards the viewer; a unit is a pixel at the face's depth;
- color: RGB, nominally 0..1, sRGB-encoded unless `Image.encoding` is "linear".
"""

from graphface.nodes.types.appearance import DetailMap, Intrinsic, Texture, TexturedMesh
from graphface.nodes.types.arrays import (
    Albedo,
    Depth,
    Detail,
    Direction,
    Encoding,
    FaceCoordinates,
    FloatArray,
    Gain,
    Mask,
    Normals,
    Shading,
    Visibility,
)
from graphface.nodes.types.correspondence import Correspondence, Pins
from graphface.nodes.types.face_parts import REGIONS, Features, HeadMasks, Regions, Segmentation
from graphface.nodes.types.geometry import Camera, FitRecord, Landmarks, Mesh, RefinedSurface, Surface
from graphface.nodes.types.illumination import Environment, Lighting, LightingFit
from graphface.nodes.types.image import FileFormat, Image
from graphface.nodes.types.judgements import Judgement, Judgements
from graphface.nodes.types.lights import DirectionalLight, EnvironmentLight, HarmonicLight, Light, PointLight, SpotLight
from graphface.nodes.types.makeup import BareSkin, Paint
from graphface.nodes.types.relighting import Samples, Shadows, Surroundings
from graphface.nodes.types.representation import Representation
from graphface.nodes.types.scene import Scene

__all__ = [
    "REGIONS",
    "Albedo",
    "BareSkin",
    "Camera",
    "Correspondence",
    "Depth",
    "Detail",
    "DetailMap",
    "Direction",
    "DirectionalLight",
    "Encoding",
    "Environment",
    "EnvironmentLight",
    "FaceCoordinates",
    "Features",
    "FileFormat",
    "FitRecord",
    "FloatArray",
    "Gain",
    "HarmonicLight",
    "HeadMasks",
    "Image",
    "Intrinsic",
    "Judgement",
    "Judgements",
    "Landmarks",
    "Light",
    "Lighting",
    "LightingFit",
    "Mask",
    "Mesh",
    "Normals",
    "Paint",
    "Pins",
    "PointLight",
    "RefinedSurface",
    "Regions",
    "Representation",
    "Samples",
    "Scene",
    "Segmentation",
    "Shading",
    "Shadows",
    "SpotLight",
    "Surface",
    "Surroundings",
    "Texture",
    "TexturedMesh",
    "Visibility",
]
