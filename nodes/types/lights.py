"""The kinds of light a scene may have.

Light is linear and counted in the photo's own unit: irradiance 1 is what the face has on average in the photo. Angles
are in degrees; azimuth 0 is where the viewer stands, positive to the picture's right, elevation positive from above.
Places and distances are in inter-ocular distances (the outer eye corners'), from the middle of the face, in the camera
frame: x right, y up, z towards the viewer.
"""

from __future__ import annotations

from typing import Annotated, Any, ClassVar, Literal, Self

import numpy as np
from numpy.typing import NDArray
from pydantic import BaseModel, ConfigDict, Field, field_validator, model_validator

from graphface.nodes.temperature import kelvin_color

Nonnegative = Annotated[float, Field(ge=0, le=1e6)]
Color = tuple[Nonnegative, Nonnegative, Nonnegative]
Coordinate = Annotated[float, Field(ge=-1e4, le=1e4)]
Point = tuple[Coordinate, Coordinate, Coordinate]
Angle = Annotated[float, Field(ge=0, le=90)]

WHITE: Color = (1.0, 1.0, 1.0)


SH_PRESETS: dict[str, tuple[float, ...]] = {
    # First order, (l, m) order: constant, up, towards the viewer, to the picture's right. Irradiance 1 in the mean.
    "ambient": (3.545, 0.0, 0.0, 0.0),
    "overcast": (2.8, 1.0, 0.5, 0.0),
    "front": (2.0, 0.2, 1.5, 0.0),
    "left": (2.2, 0.3, 0.8, -1.2),
    "right": (2.2, 0.3, 0.8, 1.2),
}


class Part(BaseModel):
    """What all parts of a scene file have in common: fixed once read, no unknown keys, no NaN."""

    model_config: ClassVar[ConfigDict] = ConfigDict(extra="forbid", frozen=True, allow_inf_nan=False)


class _Light(Part):
    """What all lights have. `_instead` names fields that stand for others: only one of them may be given."""

    _instead: ClassVar[dict[str, tuple[str, ...]]] = {"kelvin": ("color",)}

    color: Annotated[Color, Field(description="Linear RGB.", examples=[[1.0, 0.25, 0.2]])] = WHITE
    kelvin: Annotated[
        Annotated[float, Field(ge=1667, le=25000)] | None,
        Field(
            description="The color of a glowing body, in kelvin: 6500 is white, less is warmer.", examples=[2700, 5600]
        ),
    ] = None
    intensity: Annotated[
        Nonnegative,
        Field(description="Irradiance of a surface that faces the light, where the photo's face has 1 in the mean."),
    ] = 1.0

    @model_validator(mode="after")
    def _given_once(self) -> Self:
        twice = []
        for name, others in self._instead.items():
            given = [other for other in others if other in self.model_fields_set]
            if given and getattr(self, name) is not None:
                twice.append(f"either {name} or {' and '.join(given)}")
        if twice:
            raise ValueError(f"give {', '.join(twice)}, not both")
        return self

    @property
    def radiance(self) -> NDArray[np.float32]:
        """Intensity times color, linear RGB."""
        color = self.color if self.kelvin is None else kelvin_color(self.kelvin)
        return np.asarray(color, np.float32) * np.float32(self.intensity)

    @property
    def colored(self) -> bool:
        return len(set(self.radiance.tolist())) > 1


class HarmonicLight(_Light):
    """Spherical-harmonic irradiance: `coefficients` (see `graphface.nodes.sh`) or a `preset`. It casts no shadow."""

    type: Literal["sh"] = "sh"
    coefficients: Annotated[
        tuple[float, ...] | tuple[tuple[float, float, float], ...] | None,
        Field(description="1, 4, 9 or 16 in (l, m) order, each a number or linear RGB.", examples=[[2.8, 1, 0.5, 0]]),
    ] = None
    preset: Annotated[
        Literal["ambient", "overcast", "front", "left", "right"] | None, Field(description="A light by its name.")
    ] = None

    @field_validator("coefficients")
    @classmethod
    def _whole_bands(cls, given: tuple[Any, ...] | None) -> tuple[Any, ...] | None:
        if given is not None and len(given) not in (1, 4, 9, 16):
            raise ValueError("1, 4, 9 or 16 coefficients make a light")
        return given

    @model_validator(mode="after")
    def _one_source(self) -> Self:
        if (self.coefficients is None) == (self.preset is None):
            raise ValueError("give either coefficients or a preset")
        return self

    @property
    def values(self) -> NDArray[np.float32]:
        """(n,), or (n, 3) where each channel has its own."""
        values = self.coefficients if self.coefficients is not None else SH_PRESETS[self.preset or "ambient"]
        return np.asarray(values, np.float32)

    @property
    def colored(self) -> bool:
        return super().colored or self.values.ndim == 2


class _Casting(_Light):
    """A light that comes from somewhere and may cast a shadow.

    A large light wraps around the face, a small one ends in a hard line.
    """

    azimuth: Annotated[
        float, Field(ge=-360, le=360, description="Degrees from the viewer to the picture's right.", examples=[-55])
    ] = 0.0
    elevation: Annotated[float, Field(ge=-90, le=90, description="Degrees above the face.", examples=[30])] = 0.0
    size: Annotated[
        Angle, Field(description="Degrees from the light's middle to its edge, seen from the face.", examples=[5, 25])
    ] = 15.0
    shadow: Annotated[
        Literal["none", "hard", "soft"],
        Field(description="A soft shadow has the penumbra of the light's size, a hard one has none."),
    ] = "soft"

    @property
    def from_angles(self) -> NDArray[np.float32]:
        """Unit vector of azimuth and elevation."""
        a, e = np.radians(self.azimuth), np.radians(self.elevation)
        return np.array([np.sin(a) * np.cos(e), np.sin(e), np.cos(a) * np.cos(e)], np.float32)


class DirectionalLight(_Casting):
    """A light so far away that it shines in parallel. Give azimuth and elevation, or a `direction`."""

    _instead = {**_Casting._instead, "direction": ("azimuth", "elevation")}

    type: Literal["directional"] = "directional"
    direction: Annotated[
        tuple[float, float, float] | None,
        Field(description="A vector towards the light, of any length: x right, y up, z towards the viewer."),
    ] = None

    @field_validator("direction")
    @classmethod
    def _points_somewhere(cls, given: tuple[float, float, float] | None) -> tuple[float, float, float] | None:
        if given is not None and float(np.linalg.norm(given)) < 1e-6:
            raise ValueError("a direction without a length; give a vector that points towards the light")
        return given

    @property
    def towards(self) -> NDArray[np.float32]:
        """Unit vector to the light."""
        if self.direction is None:
            return self.from_angles
        vector = np.asarray(self.direction, np.float64)
        return (vector / np.linalg.norm(vector)).astype(np.float32)


class PointLight(_Casting):
    """A lamp that shines to all sides; its intensity is that at the middle of the face.

    Give azimuth, elevation and `distance`, or `position`.
    """

    _instead = {**_Casting._instead, "position": ("azimuth", "elevation", "distance")}

    type: Literal["point"] = "point"
    position: Annotated[
        Point | None,
        Field(
            description="In inter-ocular distances from the middle of the face: x right, y up, z towards the viewer.",
            examples=[[0.8, -3.0, 4.0]],
        ),
    ] = None
    distance: Annotated[
        float, Field(gt=0, le=1e4, description="In inter-ocular distances from the middle of the face.")
    ] = 4.0
    falloff: Annotated[
        float, Field(ge=0, le=8, description="Irradiance falls with this power of the distance: 2 is physical, 0 none.")
    ] = 2.0
    core: Annotated[
        float,
        Field(
            gt=0,
            le=100,
            description="In inter-ocular distances; nearer than this irradiance rises no more, so that a lamp inside "
            "the head stays finite.",
        ),
    ] = 0.25

    @property
    def place(self) -> NDArray[np.float32]:
        """Where it is, in inter-ocular distances from the middle of the face."""
        if self.position is not None:
            return np.asarray(self.position, np.float32)
        return self.from_angles * np.float32(self.distance)

    def reach(self, distance: NDArray[np.float32]) -> NDArray[np.float32]:
        """Irradiance at `distance` from the lamp relative to that at the middle of the face."""
        core = np.float32(self.core)
        reference = max(float(np.linalg.norm(self.place)), self.core)
        ratio = (np.float32(reference) / np.maximum(distance, core)) ** np.float32(self.falloff)
        return np.asarray(ratio, np.float32)


class SpotLight(PointLight):
    """A point light behind a round opening: full within `cone` of its axis, none beyond `cone` + `penumbra`."""

    type: Literal["spot"] = "spot"  # type: ignore[assignment]
    target: Annotated[
        Point, Field(description="What the axis leads to, in inter-ocular distances from the middle of the face.")
    ] = (0.0, 0.0, 0.0)
    cone: Annotated[Angle, Field(description="Degrees from the axis: a cone of 20 is 40 wide.", examples=[12])] = 20.0
    penumbra: Annotated[Angle, Field(description="Degrees beyond the cone over which the light ends.")] = 10.0

    @property
    def axis(self) -> NDArray[np.float32]:
        """Unit vector from the light to the target; straight away from the viewer where the two coincide."""
        vector = np.asarray(self.target, np.float64) - self.place
        length = float(np.linalg.norm(vector))
        return (vector / length if length > 1e-6 else np.array([0.0, 0.0, -1.0])).astype(np.float32)


class EnvironmentLight(_Light):
    """The light of the panorama that the graph is given as its input `environment`, turned by `azimuth` to the right.

    It is projected to second-order spherical harmonics, so it is soft and casts no shadow.
    """

    type: Literal["environment"] = "environment"
    azimuth: Annotated[
        float, Field(ge=-360, le=360, description="Degrees by which the panorama is turned to the right.")
    ] = 0.0

    @property
    def colored(self) -> bool:
        return True


Light = Annotated[
    DirectionalLight | PointLight | SpotLight | HarmonicLight | EnvironmentLight, Field(discriminator="type")
]


Casting = DirectionalLight | PointLight
