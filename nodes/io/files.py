"""How the types of `graphface.nodes` are read from files and written to them: the table that `pack` names.

What reads and writes is imported when a file is met. The imports stand in the functions as statements, so that the
fingerprint of a file input sees the code behind them.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any

from graphface import Files
from graphface.nodes.io.suffixes import MESHES, PICTURES


def _read_image(path: Path) -> Any:
    from graphface.nodes.io.image_read import read_image

    return read_image(path)


def _write_image(image: Any, path: Path, text: Mapping[str, str] | None = None) -> None:
    from graphface.nodes.io.image_write import write_image

    write_image(image, path, text=text)


def _text_in_picture(path: Path) -> dict[str, str]:
    from graphface.nodes.io.image_text import read_text

    return read_text(path)


def _read_mask(path: Path) -> Any:
    from graphface.nodes.color import channel_mean
    from graphface.nodes.io.image_read import read_image

    return channel_mean(read_image(path).pixels)


def _drawn(name: str) -> Callable[..., None]:
    """A writer of a map by a fixed scale: `name` is a function of `graphface.nodes.pictures.maps`."""

    def write(value: Any, path: Path, text: Mapping[str, str] | None = None) -> None:
        from graphface.nodes.io.image_write import write_picture
        from graphface.nodes.pictures import maps

        write_picture(getattr(maps, name)(value), path, text=text)

    return write


def _write_texture(texture: Any, path: Path) -> None:
    _write_image(replace(texture.image, alpha=texture.seen), path)


def _read_landmarks(path: Path) -> Any:
    from graphface.nodes.io.landmarks import read_landmarks

    return read_landmarks(path)


def _write_landmarks(landmarks: Any, path: Path) -> None:
    from graphface.nodes.io.landmarks import write_landmarks

    write_landmarks(landmarks, path)


def _write_mesh(mesh: Any, path: Path) -> None:
    from graphface.nodes.io.mesh import write_mesh

    write_mesh(mesh, path)


def _check_mesh(path: Path) -> None:
    from graphface.nodes.io.mesh import check_mesh_writer

    check_mesh_writer(path)


def _write_textured(textured: Any, path: Path) -> None:
    from graphface.nodes.io.mesh import write_mesh

    write_mesh(textured.mesh, path, textured.texture)


def _read_model(path: Path) -> Any:
    from graphface.nodes.morphable.storage import load_model

    return load_model(path)


def _write_model(model: Any, path: Path) -> None:
    from graphface.nodes.morphable.storage import save_model

    save_model(model, path)


def _read_environment(path: Path) -> Any:
    from graphface.nodes.io.panorama import read_panorama

    return read_panorama(path)


def _write_environment(environment: Any, path: Path) -> None:
    from graphface.nodes.io.panorama import write_panorama

    write_panorama(environment, path)


def _read_scene(path: Path) -> Any:
    from graphface import read_yaml
    from graphface.nodes.types import Scene

    return read_yaml(path, Scene)


def _read_pins(path: Path) -> Any:
    from graphface.nodes.io.pins import read_pins

    return read_pins(path)


def _read_judgements(path: Path) -> Any:
    from graphface.nodes.io.judgements import read_judgements

    return read_judgements(path)


def _read_representation(path: Path) -> Any:
    from graphface.nodes.io.representation import read_representation

    return read_representation(path)


def _write_representation(representation: Any, path: Path) -> None:
    from graphface.nodes.io.representation import write_representation

    write_representation(representation, path)


IMAGE = Files(_read_image, _write_image, PICTURES, _text_in_picture)
MASK = Files(_read_mask, _drawn("as_bytes"), PICTURES)
SHADING = Files(write=_drawn("as_bytes"), suffixes=PICTURES)
NORMALS = Files(write=_drawn("normals_bytes"), suffixes=PICTURES)
DEPTH = Files(write=_drawn("depth_bytes"), suffixes=PICTURES)
DETAIL = Files(write=_drawn("signed_bytes"), suffixes=PICTURES)
ALBEDO = GAIN = Files(write=_drawn("albedo_bytes"), suffixes=PICTURES)
TEXTURE = Files(write=_write_texture, suffixes=PICTURES)
LANDMARKS = Files(_read_landmarks, _write_landmarks, (".pts", ".csv", ".npy"))
MESH = Files(write=_write_mesh, suffixes=MESHES, check=_check_mesh)
TEXTURED_MESH = Files(write=_write_textured, suffixes=MESHES, check=_check_mesh)
MODEL = Files(_read_model, _write_model, (".safetensors",))
ENVIRONMENT = Files(_read_environment, _write_environment, (".exr", ".hdr", ".pic", *PICTURES))
SCENE = Files(_read_scene)
PINS = Files(_read_pins)
JUDGEMENTS = Files(_read_judgements)
REPRESENTATION = Files(_read_representation, _write_representation, (".face", ".safetensors"))
