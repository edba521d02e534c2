"""The whole representation of a face (paper, section 2) as one value and one file.

Computed once, it can be edited anywhere: `graphface run represent -i photo=a.jpg -o representation=a.face` writes it,
`graphface run relight-saved -i saved=a.face -o b.png` starts from it, with nothing to detect or to fit.
"""

from __future__ import annotations

import json
from dataclasses import dataclass
from pathlib import Path

from graphface import UnreadableFile, UnwritableFile, node
from graphface.nodes.render.spread import Surroundings
from graphface.nodes.types import (
    Albedo,
    DetailMap,
    Image,
    Landmarks,
    Lighting,
    Mask,
    Mesh,
    Segmentation,
    Shading,
    Surface,
)

_FORMAT = "graphface representation 1"


@dataclass(frozen=True)
class Representation:
    """Everything that `represent.yaml` finds in a photo; the fields are its outputs of the same names."""

    working: Image
    landmarks: Landmarks
    mesh: Mesh
    surface: Surface
    mask: Mask
    labels: Segmentation
    head: Mesh
    head_surface: Surface
    head_mask: Mask
    surroundings: Surroundings
    albedo: Albedo
    shading: Shading
    light: Lighting
    estimated: Shading
    spread: Shading
    detail: DetailMap

    @classmethod
    def from_file(cls, path: Path) -> Representation:
        """Read what `to_file` wrote.

        Raises:
            UnreadableFile: not there, not a representation, or written by another version of these types.
        """
        from safetensors import SafetensorError, safe_open

        from graphface.values.codec import CodecError, decode

        path = Path(path)
        if not path.is_file():
            raise UnreadableFile(path, "no such file")
        try:
            with safe_open(path, framework="numpy") as file:
                words = file.metadata() or {}
                tensors = {name: file.get_tensor(name) for name in file.keys()}  # noqa: SIM118 - not a mapping
            if words.get("format") != _FORMAT:
                raise UnreadableFile(path, f"not a {_FORMAT!r} file")
            found: Representation = decode(tensors, json.loads(words["structure"]), cls)
        except (SafetensorError, CodecError, ValueError, KeyError, OSError) as error:
            raise UnreadableFile(path, f"damaged, or no representation ({error})") from None
        return found

    @staticmethod
    def to_file(representation: Representation, path: Path) -> None:
        """Write as safetensors: arrays as they are, everything else as JSON in the header; about 150 bytes a pixel.

        Raises:
            UnwritableFile: the folder cannot be written to.
        """
        from safetensors import SafetensorError
        from safetensors.numpy import save_file

        from graphface.values.codec import encode
        from graphface.values.writing import beside

        tensors, structure = encode(representation)
        words = {"format": _FORMAT, "structure": json.dumps(structure)}
        with beside(Path(path)) as temporary:
            try:
                save_file(tensors, temporary, words)
            except (SafetensorError, OSError) as error:
                raise UnwritableFile(path, str(error)) from None


@node("representation.bundle")
def bundle(
    working: Image,
    landmarks: Landmarks,
    mesh: Mesh,
    surface: Surface,
    mask: Mask,
    labels: Segmentation,
    head: Mesh,
    head_surface: Surface,
    head_mask: Mask,
    surroundings: Surroundings,
    albedo: Albedo,
    shading: Shading,
    light: Lighting,
    estimated: Shading,
    spread: Shading,
    detail: DetailMap,
) -> Representation:
    """Put the parts of a representation into one value, which can be saved."""
    return Representation(**locals())


@node("representation.given")
def given(saved: Representation) -> Representation:
    """A representation from elsewhere, in the place of the graph that computes one."""
    return saved
