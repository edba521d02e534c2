"""The kinds of light a scene may have.

Light is linear and counted in the photo's own unit: irradiance 1 is what the face has on average in the photo. Angles
are in degrees; azimuth 0 is where the viewer stands, positive to the picture's right, elevation positive from above.
Places and distances are in inter-ocular distances (the outer eye corners'), from the middle of the face, in the camera
frame: x right, y up, z towards the viewer.
"""

from __future__ import annotations

from typing import Annotated, Literal

import numpy as np
from numpy.typing import NDArray
from pydantic import BaseModel, ConfigDict, Field, model_validator

from graphface.nodes.temperature import kelvin_color

Nonnegative = Annotated[float, Field(ge=0, le=1e6)]


Color = tuple[Nonnegative, Nonnegative, Nonnegative]


Azimuth = Annotated[float, Field(ge=-360, le=360)]


Elevation = Annotated[float, Field(ge=-90, le=90)]


Size = Annotated[float, Field(ge=0, le=90)]


Coordinate = Annotated[float, Field(ge=-1e4, le=1e4)]


Point = tuple[Coordinate, Coordinate, Coordinate]


Shadow = Literal["none", "hard", "soft"]


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

    model_config = ConfigDict(extra="forbid", frozen=True, allow_inf_nan=False)


class _Light(Part):
    """`color` is linear RGB; or give `kelvin`, 6500 for white, less for warmer. `intensity` multiplies it."""

    color: Color = WHITE
    kelvin: Annotated[float, Field(ge=1667, le=25000)] | None = None
    intensity: Nonnegative = 1.0

    @model_validator(mode="after")
    def _one_color(self) -> _Light:
        if self.kelvin is not None and "color" in self.model_fields_set:
            raise ValueError("give either a color or kelvin, not both")
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
    """Spherical-harmonic irradiance: `coefficients` (1, 4, 9 or 16, see `graphface.nodes.sh`), a number or RGB each, or
    a named preset. It casts no shadow.
    """

    type: Literal["sh"] = "sh"
    coefficients: tuple[float, ...] | tuple[tuple[float, float, float], ...] | None = None
    preset: Literal["ambient", "overcast", "front", "left", "right"] | None = None

    @model_validator(mode="after")
    def _one_source(self) -> HarmonicLight:
        if (self.coefficients is None) == (self.preset is None):
            raise ValueError("give either coefficients or a preset")
        if self.coefficients is not None and len(self.coefficients) not in (1, 4, 9, 16):
            raise ValueError(f"1, 4, 9 or 16 coefficients make a light, got {len(self.coefficients)}")
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

    `size` is the angle from the light's middle to its edge, seen from the face: a large light wraps around the face, a
    small one ends in a hard line. A `soft` shadow has the penumbra of that size, a `hard` one has none.
    """

    azimuth: Azimuth = 0.0
    elevation: Elevation = 0.0
    size: Size = 15.0
    shadow: Shadow = "soft"

    @property
    def from_angles(self) -> NDArray[np.float32]:
        """Unit vector of azimuth and elevation."""
        a, e = np.radians(self.azimuth), np.radians(self.elevation)
        return np.array([np.sin(a) * np.cos(e), np.sin(e), np.cos(a) * np.cos(e)], np.float32)

    def refuse_angles(self, instead: str) -> None:
        if {"azimuth", "elevation"} & self.model_fields_set:
            raise ValueError(f"give either a {instead} or azimuth and elevation, not both")


class DirectionalLight(_Casting):
    """A light so far away that it shines in parallel; a surface facing it gets irradiance `intensity`.

    Give azimuth and elevation, or `direction`, a vector towards the light.
    """

    type: Literal["directional"] = "directional"
    direction: tuple[float, float, float] | None = None

    @model_validator(mode="after")
    def _one_direction(self) -> DirectionalLight:
        if self.direction is not None:
            self.refuse_angles("direction")
            if float(np.linalg.norm(self.direction)) < 1e-6:
                raise ValueError("the direction has no length; give a vector that points towards the light")
        return self

    @property
    def towards(self) -> NDArray[np.float32]:
        """Unit vector to the light."""
        if self.direction is None:
            return self.from_angles
        vector = np.asarray(self.direction, np.float64)
        return (vector / np.linalg.norm(vector)).astype(np.float32)


class PointLight(_Casting):
    """A lamp that shines to all sides; a surface at the middle of the face, facing it, gets irradiance `intensity`.

    Give azimuth, elevation and `distance`, or `position`. Irradiance falls with distance to the power `falloff`: 2 is
    physical, 0 none. Nearer than `core` it rises no more, so a lamp inside the head stays finite.
    """

    type: Literal["point"] = "point"
    position: Point | None = None
    distance: Annotated[float, Field(gt=0, le=1e4)] = 4.0
    falloff: Annotated[float, Field(ge=0, le=8)] = 2.0
    core: Annotated[float, Field(gt=0, le=100)] = 0.25

    @model_validator(mode="after")
    def _one_place(self) -> PointLight:
        if self.position is not None:
            self.refuse_angles("position")
            if "distance" in self.model_fields_set:
                raise ValueError("give either a position or a distance, not both")
        return self

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
    """A point light behind a round opening: full within `cone` of its axis, none beyond `cone` + `penumbra`.

    The axis runs from the light to `target`; both angles are measured from the axis, so a cone of 20 is 40 wide.
    """

    type: Literal["spot"] = "spot"  # type: ignore[assignment]
    target: Point = (0.0, 0.0, 0.0)
    cone: Annotated[float, Field(ge=0, le=90)] = 20.0
    penumbra: Annotated[float, Field(ge=0, le=90)] = 10.0

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
    azimuth: Azimuth = 0.0

    @property
    def colored(self) -> bool:
        return True


Light = Annotated[
    DirectionalLight | PointLight | SpotLight | HarmonicLight | EnvironmentLight, Field(discriminator="type")
]


Casting = DirectionalLight | PointLight
