"""The values that travel between face operators.

Maps (masks, normals, depth, albedo, shading, detail) are plain float32 arrays whose meaning stands in their type; what
has several parts is a frozen dataclass. Conventions (pixel coordinates, camera frame, colour encoding) are those of
every operator, so they are stated once, here:

- pixels: x right, y down, integer coordinates at pixel centres;
- camera frame: right-handed, x right, y up, z towards the viewer, one unit = one pixel at the face's depth;
- colour: RGB, nominally 0..1, sRGB-encoded unless `Image.encoding` says "linear".
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Annotated, Any, Literal

import numpy as np
from numpy.typing import NDArray

from graphface import ArrayType

FloatArray = NDArray[np.float32]
Encoding = Literal["srgb", "linear"]

PICTURES = (".png", ".jpg", ".jpeg", ".webp", ".tif", ".tiff")
"""The suffixes that pictures are written as."""


def _as_bytes(unit: NDArray[np.floating[Any]]) -> NDArray[np.uint8]:
    pixels = np.rint(np.clip(unit, 0, 1) * 255).astype(np.uint8)
    return pixels if pixels.ndim == 3 else np.repeat(pixels[..., None], 3, axis=2)


def _picture_unit(values: FloatArray) -> NDArray[np.uint8]:
    return _as_bytes(values)


def _picture_albedo(albedo: FloatArray) -> NDArray[np.uint8]:
    """Colour over shading averages 1 where shading is intensity; half of it is mid grey."""
    return _as_bytes(albedo / 2)


def _picture_normals(normals: FloatArray) -> NDArray[np.uint8]:
    """Normals as colours, (n + 1) / 2; black where there is no surface (a zero vector)."""
    covered = np.any(normals != 0, axis=2, keepdims=True)
    return _as_bytes(np.where(covered, (normals + 1) / 2, 0))


def _picture_signed(values: FloatArray) -> NDArray[np.uint8]:
    """Mid grey is zero."""
    return _as_bytes(values + 0.5)


def _picture_gain(values: FloatArray) -> NDArray[np.uint8]:
    """Mid grey is one."""
    return _as_bytes(values / 2)


def _picture_depth(depth: FloatArray) -> NDArray[np.uint8]:
    """Near is white, far is dark, no surface (0) is black."""
    covered = depth != 0
    if not covered.any():
        return _as_bytes(np.zeros_like(depth))
    low, high = depth[covered].min(), depth[covered].max()
    return _as_bytes(np.where(covered, 0.15 + 0.85 * (depth - low) / max(high - low, 1e-6), 0))


def _map(name: str, shape: str, doc: str, picture: Any, **more: Any) -> ArrayType:
    return ArrayType(name, shape, doc=doc, picture=picture, **more)


Mask = Annotated[
    FloatArray,
    _map("Mask", "H W", "Coverage, 0 outside to 1 inside.", _picture_unit, low=0, high=1),
]
Normals = Annotated[
    FloatArray,
    _map(
        "Normals", "H W 3", "Unit normals in the camera frame; (0, 0, 0): no surface.", _picture_normals, low=-1, high=1
    ),
]
Depth = Annotated[
    FloatArray,
    _map(
        "Depth", "H W", "z in the camera frame, pixels, larger is nearer; 0 where there is no surface.", _picture_depth
    ),
]
Albedo = Annotated[FloatArray, _map("Albedo", "H W 3", "Reflectance: colour over shading.", _picture_albedo, low=0)]
Shading = Annotated[FloatArray, _map("Shading", "...", "Irradiance, H x W or H x W x 3.", _picture_unit, low=0)]
Detail = Annotated[FloatArray, _map("Detail", "H W 3", "What rendering leaves over, signed.", _picture_signed)]
Direction = Annotated[FloatArray, ArrayType("Direction", "3", doc="Unit vector in the camera frame; zero: none.")]
Gain = Annotated[FloatArray, _map("Gain", "H W 3", "What rendering falls short of, as a factor.", _picture_gain, low=0)]


@dataclass(frozen=True)
class FileFormat:
    """What a picture file carries besides its pixels, kept so that saving gives it back.

    `bits` is 8 or 16 a channel; `icc` and `exif` are the raw blocks (EXIF with its orientation already applied and
    reset), `grey` where the file had a single channel.
    """

    name: str = "PNG"
    bits: int = 8
    icc: bytes | None = None
    exif: bytes | None = None
    grey: bool = False


@dataclass(frozen=True)
class Image:
    """A photograph: `pixels` float32 H x W x 3 RGB, nominally 0..1; `alpha` float32 H x W or None."""

    pixels: FloatArray
    alpha: FloatArray | None = None
    encoding: Encoding = "srgb"
    file: FileFormat = FileFormat()

    suffixes = PICTURES

    @property
    def height(self) -> int:
        return int(self.pixels.shape[0])

    @property
    def width(self) -> int:
        return int(self.pixels.shape[1])

    def with_pixels(self, pixels: FloatArray, encoding: Encoding | None = None) -> Image:
        """The same picture with other pixels: alpha and what the file carried are kept."""
        return replace(self, pixels=pixels.astype(np.float32, copy=False), encoding=encoding or self.encoding)

    @classmethod
    def from_file(cls, path: Path) -> Image:
        from graphface.nodes.image import read_image

        return read_image(path)

    @staticmethod
    def to_file(image: Image, path: Path, text: Mapping[str, str] | None = None) -> None:
        from graphface.nodes.image import write_image

        write_image(image, path, text=text)

    @staticmethod
    def text_in_file(path: Path) -> dict[str, str]:
        from graphface.nodes.image import read_text

        return read_text(path)

    @classmethod
    def coerce(cls, value: object) -> Image:
        from graphface.nodes.image import image_from_array

        return image_from_array(value)

    @staticmethod
    def picture(image: Image) -> NDArray[np.uint8]:
        from graphface.nodes.image import encode_srgb

        return _as_bytes(encode_srgb(image.pixels) if image.encoding == "linear" else image.pixels)


@dataclass(frozen=True)
class Camera:
    """Camera frame to pixels: u = cx + scale * x / (1 - z * nearness), v = cy - scale * y / (1 - z * nearness).

    `nearness` is one over the camera's distance: 0 is the weak perspective (a camera infinitely far away), and full
    perspective is continuous with it.
    """

    scale: float = 1.0
    center: tuple[float, float] = (0.0, 0.0)
    nearness: float = 0.0

    def project(self, vertices: NDArray[np.floating[Any]]) -> NDArray[np.floating[Any]]:
        """Camera-frame points (..., 3) to pixel coordinates (..., 2)."""
        factor = self.scale / np.maximum(1 - vertices[..., 2] * self.nearness, 1e-3)
        x = self.center[0] + factor * vertices[..., 0]
        y = self.center[1] - factor * vertices[..., 1]
        return np.stack([x, y], axis=-1)


@dataclass(frozen=True)
class Landmarks:
    """The points found on one face.

    `points` float32 (n, 3): x, y in pixels, z in pixels towards the viewer (0 where the scheme has no depth).
    `scheme` names the points: "facemesh468" or "ibug68". `score` is the detector's confidence, 0..1. `faces` is how
    many faces the photo has.
    """

    points: FloatArray
    scheme: str
    score: float = 1.0
    faces: int = 1

    @property
    def interocular(self) -> float:
        """Distance between the outer eye corners, in pixels: the unit of every face-relative length."""
        left, right = {"facemesh468": (33, 263), "ibug68": (36, 45)}[self.scheme]
        return float(np.linalg.norm(self.points[left] - self.points[right]))

    @classmethod
    def from_file(cls, path: Path) -> Landmarks:
        from graphface.nodes.landmarks.files import read_landmarks

        return read_landmarks(path)

    @staticmethod
    def to_file(landmarks: Landmarks, path: Path) -> None:
        from graphface.nodes.landmarks.files import write_landmarks

        write_landmarks(landmarks, path)


@dataclass(frozen=True)
class FitRecord:
    """How a face model was fitted: what it found, and how well.

    `identity` and `expression` float32 (K,) in standard deviations; `rotation` float64 (3, 3), face to camera frame;
    `scale` pixels for one outer-eye-corner distance of the mean face; `distance` of the camera in that unit, 0 for the
    weak perspective. `errors` float32 (n,) pixels from each landmark to its vertex, NaN-free: 0 where there is no
    landmark; `residual` their root mean square, robustly weighted; `costs` after each accepted step; `condition` of the
    last step's equations; `converged` where the cost came to rest.
    """

    model: str
    identity: FloatArray
    expression: FloatArray
    rotation: NDArray[np.float64]
    scale: float
    distance: float
    residual: float
    errors: FloatArray
    costs: FloatArray
    condition: float
    converged: bool


@dataclass(frozen=True)
class Mesh:
    """A triangulated face in the camera frame.

    `vertices` float32 (V, 3); `triangles` int32 (T, 3), counter-clockwise seen from outside; `normals` float32 (V, 3)
    unit; `camera` takes vertices to pixels; `interocular` in pixels. `uv` float32 (V, 2) in [0, 1], v up: where the
    model's texture has each vertex. `mirror` int32 (V,): the vertex that each becomes in a mirror, where that is known.
    `facemesh` int32 (468,): the vertex at each of FaceMesh's points, -1 where there is none. `fit` where a model was
    fitted.
    """

    vertices: FloatArray
    triangles: NDArray[np.int32]
    normals: FloatArray
    camera: Camera
    interocular: float
    uv: FloatArray | None = None
    mirror: NDArray[np.int32] | None = None
    facemesh: NDArray[np.int32] | None = None
    fit: FitRecord | None = None

    suffixes = (".obj", ".ply", ".glb", ".gltf")

    @staticmethod
    def to_file(mesh: Mesh, path: Path) -> None:
        from graphface.nodes.projection.export import write_mesh

        write_mesh(mesh, path)


@dataclass(frozen=True)
class Surface:
    """A mesh drawn into the picture's pixels.

    `triangle` int32 H x W: index of the visible triangle, -1 where there is none; `barycentric` float32 H x W x 3.
    """

    normals: Normals
    depth: Depth
    coverage: Mask
    triangle: NDArray[np.int32]
    barycentric: FloatArray


@dataclass(frozen=True)
class HeadMasks:
    """What the projected geometry alone says (paper, section 2, "Face segmentation"); each is 0 or 1, H x W.

    `conservative` is surely face, `normal` about face and head with ears, `aggressive` all that may be face.
    """

    conservative: Mask
    normal: Mask
    aggressive: Mask


@dataclass(frozen=True)
class Segmentation:
    """How much of each pixel is face (with ears and neck), hair, and background: H x W each, summing to 1."""

    face: Mask
    hair: Mask
    background: Mask

    @staticmethod
    def picture(segmentation: Segmentation) -> NDArray[np.uint8]:
        """Red is hair, green is face."""
        parts = [segmentation.hair, segmentation.face, np.zeros_like(segmentation.face)]
        return _as_bytes(np.stack(parts, axis=2))


@dataclass(frozen=True)
class Intrinsic:
    """A picture split into `albedo` (H x W x 3) and `shading` (H x W): their product is the picture."""

    albedo: Albedo
    shading: Shading


@dataclass(frozen=True)
class DetailMap:
    """What the photo has and rendering lacks: photo = gain * rendering + offset.

    One form for every method: the paper's additive map is all `offset` (`gain` None stands for 1), the shading ratio is
    all `gain`. Whoever recombines (`graphface.nodes.detail.applied`) needs not know which method it was.

    Where there is a `pivot`, the gain holds up to that rendering and light beyond it adds as it is:
    photo = gain * min(rendering, pivot) + max(rendering - pivot, 0) + offset.

    Where there is a `ceiling`, all but that light beyond the pivot stays below it: so a photo whose clipped highlights
    were reconstructed beyond what it shows is shown as it is.
    """

    offset: Detail
    gain: Gain | None = None
    pivot: Albedo | None = None
    ceiling: FloatArray | None = None

    @staticmethod
    def picture(detail: DetailMap) -> NDArray[np.uint8]:
        return _picture_signed(detail.offset) if detail.gain is None else _picture_gain(detail.gain)


@dataclass(frozen=True)
class Lighting:
    """Spherical-harmonic light: `coefficients` float32 (n,) or (n, 3), real basis in (l, m) order with the constants
    of Ramamoorthi and Hanrahan 2001; n = 1, 4, 9 or 16. Shading is sum_i coefficients[i] * Y_i(normal).
    """

    coefficients: FloatArray

    @property
    def order(self) -> int:
        return round(float(np.sqrt(self.coefficients.shape[0]))) - 1


@dataclass(frozen=True)
class LightingFit:
    """A fitted light, with `residual` (H x W, shading minus fit inside the mask, else 0), the solve's condition, and
    the unit `direction` towards most of the light, (0, 0, 0) where it comes evenly."""

    light: Lighting
    residual: Shading
    condition: float
    direction: Direction = field(default_factory=lambda: np.zeros(3, np.float32))
