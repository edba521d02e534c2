"""What the picture is to be lit by: scene files and their lights.

    doc: A window to the left.
    mode: replace
    ambient: 0.3
    lights:
      - {type: directional, azimuth: -55, elevation: 20, intensity: 1.2, color: [1, 0.95, 0.88]}

Light is linear and counted in the photo's own unit: irradiance 1 is what the face has on average in the photo. So an
ambient of 1 leaves the brightness as it is, and a scene means the same for a bright photo and for a dark one.
"""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Any, Literal

import numpy as np
from numpy.typing import NDArray
from pydantic import BaseModel, ConfigDict, Field, ValidationError, model_validator

from graphface import UnreadableFile

Nonnegative = Annotated[float, Field(ge=0, le=1e6)]
Color = tuple[Nonnegative, Nonnegative, Nonnegative]
WHITE: Color = (1.0, 1.0, 1.0)

SH_PRESETS: dict[str, tuple[float, ...]] = {
    # First order, (l, m) order: constant, up, towards the viewer, to the picture's right. Irradiance 1 in the mean.
    "ambient": (3.545, 0.0, 0.0, 0.0),
    "overcast": (2.8, 1.0, 0.5, 0.0),
    "front": (2.0, 0.2, 1.5, 0.0),
    "left": (2.2, 0.3, 0.8, -1.2),
    "right": (2.2, 0.3, 0.8, 1.2),
}


class _Part(BaseModel):
    model_config = ConfigDict(extra="forbid", frozen=True, allow_inf_nan=False)


class _Light(_Part):
    color: Color = WHITE
    intensity: Nonnegative = 1.0

    @property
    def radiance(self) -> NDArray[np.float32]:
        """Intensity times colour, linear RGB."""
        return np.asarray(self.color, np.float32) * np.float32(self.intensity)


class DirectionalLight(_Light):
    """A light so far away that it shines in parallel; a surface facing it gets irradiance `intensity`.

    Azimuth, in degrees: 0 is where the viewer stands, positive to the picture's right. Elevation: positive from above.
    Or give `direction`, a vector towards the light in the camera frame (x right, y up, z towards the viewer). `size`
    is the angle from the light's middle to its edge: a large light wraps around the face, a small one ends in a hard
    line.
    """

    type: Literal["directional"] = "directional"
    azimuth: Annotated[float, Field(ge=-360, le=360)] = 0.0
    elevation: Annotated[float, Field(ge=-90, le=90)] = 0.0
    direction: tuple[float, float, float] | None = None
    size: Annotated[float, Field(ge=0, le=90)] = 15.0

    @model_validator(mode="after")
    def _one_direction(self) -> DirectionalLight:
        if self.direction is not None:
            if {"azimuth", "elevation"} & self.model_fields_set:
                raise ValueError("give either a direction or azimuth and elevation, not both")
            if float(np.linalg.norm(self.direction)) < 1e-6:
                raise ValueError("the direction has no length; give a vector that points towards the light")
        return self

    @property
    def towards(self) -> NDArray[np.float32]:
        """Unit vector to the light."""
        if self.direction is not None:
            vector = np.asarray(self.direction, np.float64)
            return (vector / np.linalg.norm(vector)).astype(np.float32)
        a, e = np.radians(self.azimuth), np.radians(self.elevation)
        return np.array([np.sin(a) * np.cos(e), np.sin(e), np.cos(a) * np.cos(e)], np.float32)


class HarmonicLight(_Light):
    """Spherical-harmonic irradiance: `coefficients` (1, 4, 9 or 16, see `graphface.nodes.sh`) or a named preset."""

    type: Literal["sh"] = "sh"
    coefficients: tuple[float, ...] | None = None
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
        values = self.coefficients if self.coefficients is not None else SH_PRESETS[self.preset or "ambient"]
        return np.asarray(values, np.float32)


Light = Annotated[DirectionalLight | HarmonicLight, Field(discriminator="type")]


class Scene(_Part):
    """A scene file's content.

    `mode`: the lights `replace` the photo's own, are `add`ed to it, or `mix` with it by the share `mix`. With
    `keep_mean` (replace and mix) the lights are scaled together so that the face stays as bright as it was, times
    `exposure`; without it irradiance is taken as written, times `exposure`. `background` is the share of the new light
    far from the face.
    """

    doc: str = ""
    mode: Literal["replace", "add", "mix"] = "replace"
    mix: Annotated[float, Field(ge=0, le=1)] = 0.5
    ambient: Nonnegative | Color = 0.0
    lights: tuple[Light, ...] = ()
    keep_mean: bool = True
    exposure: Annotated[float, Field(ge=0, le=100)] = 1.0
    background: Annotated[float, Field(ge=0, le=1)] = 0.35

    @property
    def colored(self) -> bool:
        """Whether any light is coloured: only then has the shading three channels."""
        return any(len(set(light.color)) > 1 for light in self.lights) or (
            isinstance(self.ambient, tuple) and len(set(self.ambient)) > 1
        )

    @classmethod
    def from_file(cls, path: Path) -> Scene:
        """Read a scene file.

        Raises:
            UnreadableFile: not readable, not YAML, or not a scene; with the line and what was expected.
        """
        return _read(Path(path))

    @classmethod
    def coerce(cls, value: object) -> Scene:
        """A scene from a mapping, or from the path of a scene file."""
        if isinstance(value, Scene):
            return value
        if isinstance(value, str | Path):
            return cls.from_file(Path(value))
        try:
            return cls.model_validate(value)
        except ValidationError as error:
            place, message = _first_problem(error)
            raise ValueError(f"not a scene: {'.'.join(map(str, place))}: {message}") from None


def _read(path: Path) -> Scene:
    import yaml

    try:
        text = path.read_text(encoding="utf-8")
        tree = yaml.compose(text, Loader=yaml.SafeLoader)
        content = yaml.safe_load(text)
    except OSError as error:
        raise UnreadableFile(path, error.strerror or "cannot be read") from None
    except UnicodeDecodeError:
        raise UnreadableFile(path, "is not a text file; a scene is a YAML file") from None
    except yaml.YAMLError as error:
        mark = getattr(error, "problem_mark", None)
        raise UnreadableFile(_at(path, mark), f"not YAML: {getattr(error, 'problem', error)}") from None
    if not isinstance(content, dict):
        raise UnreadableFile(path, "a scene is a mapping with keys such as lights, ambient and mode")
    try:
        return Scene.model_validate(content)
    except ValidationError as error:
        place, message = _first_problem(error)
        name = ".".join(map(str, place))
        raise UnreadableFile(_at(path, _mark(tree, place)), f"{name}: {message}" if name else message) from None


def _first_problem(error: ValidationError) -> tuple[tuple[int | str, ...], str]:
    """Where the first problem is, by keys and positions as written in the file, and what it is."""
    problem = error.errors()[0]
    alternatives = {"directional", "sh", "constrained-float", "function-after"}
    place = tuple(key for key in problem["loc"] if key not in alternatives and not str(key).startswith("tuple["))
    message = problem["msg"].removeprefix("Value error, ")
    return place, "unknown key" if problem["type"] == "extra_forbidden" else message


def _mark(tree: Any, place: tuple[int | str, ...]) -> Any:
    """The deepest position in the YAML tree that a place leads to."""
    mark = tree.start_mark
    for key in place:
        if isinstance(key, int) and isinstance(tree.value, list) and key < len(tree.value):
            tree = tree.value[key]
            mark = tree.start_mark
            continue
        pair = next((p for p in tree.value if isinstance(p, tuple) and p[0].value == key), None)
        if pair is None:
            break
        mark, tree = pair[0].start_mark, pair[1]
    return mark


def _at(path: Path, mark: Any) -> str:
    return f"{path}:{mark.line + 1}:{mark.column + 1}" if mark is not None else str(path)
