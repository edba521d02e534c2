"""What the picture is to be lit by: scene files.

    doc: A window to the left.
    mode: replace
    ambient: 0.3
    lights:
      - {type: directional, azimuth: -55, elevation: 20, intensity: 1.2, kelvin: 5200, shadow: soft}
      - {type: spot, azimuth: 60, elevation: 30, distance: 4, cone: 12, color: [0.4, 0.5, 1.0]}

An ambient of 1 leaves the brightness as it is, and a scene means the same for a bright photo and for a dark one; see
`graphface.nodes.types.lights` for the units and the kinds of light.
"""

from __future__ import annotations

from typing import Annotated, Literal

import numpy as np
from pydantic import Field

from graphface import validated
from graphface.nodes.types.lights import (
    Casting,
    Color,
    DirectionalLight,
    EnvironmentLight,
    HarmonicLight,
    Light,
    Nonnegative,
    Part,
    PointLight,
)

_BEHIND = -0.9
"""Cosine to the viewer's direction below which a light only grazes what the camera sees: its shadow would not show."""


class Scene(Part):
    """A scene file's content. At background 1, hair 0, scatter 0 and specular 0 none of these is simulated."""

    doc: Annotated[str, Field(description="What the scene is, in a sentence.")] = ""
    mode: Annotated[
        Literal["replace", "add", "mix"],
        Field(description="The lights replace the photo's own, are added to it, or mix with it."),
    ] = "replace"
    mix: Annotated[float, Field(ge=0, le=1, description="Share of the new light in mode mix.")] = 0.5
    ambient: Annotated[
        Nonnegative | Color,
        Field(
            description="Light from everywhere, a number or linear RGB; 1 leaves the brightness as it is.",
            examples=[0.3, [0.06, 0.08, 0.12]],
        ),
    ] = 0.0
    lights: Annotated[tuple[Light, ...], Field(description="Any number of lights, whose effects add up.")] = ()
    keep_mean: Annotated[
        bool,
        Field(
            description="In modes replace and mix the lights are scaled together so that the face stays as bright as "
            "it was; otherwise irradiance is taken as written."
        ),
    ] = True
    exposure: Annotated[float, Field(ge=0, le=100, description="Multiplies the light that results.")] = 1.0
    background: Annotated[
        float, Field(ge=0, le=1, description="Share of the new light on what is neither face nor hair.")
    ] = 0.6
    hair: Annotated[
        float, Field(ge=0, le=1, description="Share of the old light that hair keeps at its highlights.")
    ] = 0.3
    scatter: Annotated[
        float,
        Field(ge=0, le=1, description="Radius, in inter-ocular distances, over which light spreads beneath the skin."),
    ] = 0.0
    specular: Annotated[
        float, Field(ge=0, le=10, description="Strength of the highlights that the new lights make on the skin.")
    ] = 0.5
    roughness: Annotated[
        float, Field(ge=0.05, le=1, description="Width of these highlights: the roughness of the skin's surface.")
    ] = 0.5

    @property
    def colored(self) -> bool:
        """Whether any light is colored: only then has the shading three channels."""
        ambient = isinstance(self.ambient, tuple) and len(set(self.ambient)) > 1
        return ambient or any(light.colored for light in self.lights)

    @property
    def unchanged(self) -> bool:
        """Whether the scene is the photo's own light, whatever the photo."""
        if self.mode == "mix":
            return self.mix == 0
        return self.mode == "add" and (self.exposure == 0 or self.dark)

    @property
    def dark(self) -> bool:
        """Whether there is no light in it."""
        return not np.any(self.ambient) and not any(light.radiance.any() for light in self.lights)

    @property
    def local(self) -> bool:
        """Whether a light is near enough that it matters where a point of the face lies."""
        return any(isinstance(light, PointLight) for light in self.lights)

    @property
    def surrounded(self) -> bool:
        """Whether a panorama lights the face."""
        return any(isinstance(light, EnvironmentLight) and light.radiance.any() for light in self.lights)

    @property
    def glossy(self) -> bool:
        """Whether a light makes highlights on the skin."""
        return self.specular > 0 and any(
            not isinstance(light, HarmonicLight | EnvironmentLight) and light.radiance.any() for light in self.lights
        )

    @property
    def casting(self) -> dict[int, Casting]:
        """The lights that cast a shadow that the camera could see, by their place in `lights`."""
        return {
            index: light
            for index, light in enumerate(self.lights)
            if not isinstance(light, HarmonicLight | EnvironmentLight)
            and light.shadow != "none"
            and light.radiance.any()
            and _toward_viewer(light) > _BEHIND
        }

    @classmethod
    def coerce(cls, value: object) -> Scene:
        """A scene from a mapping.

        Raises:
            DocumentError: it is not a scene; every mistake, and what was expected.
        """
        return validated(value, cls)


def _toward_viewer(light: Casting) -> float:
    """Cosine between the light's direction and the viewer's, seen from the middle of the face."""
    if isinstance(light, DirectionalLight):
        return float(light.towards[2])
    return float(light.place[2]) / max(float(np.linalg.norm(light.place)), 1e-6)
