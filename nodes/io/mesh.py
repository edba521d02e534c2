"""Files of meshes: OBJ, PLY, glTF and GLB, with a texture, written by trimesh."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

from graphface import UnwritableFile, UsageError
from graphface.nodes.face_coordinates import mesh_uv
from graphface.nodes.io.suffixes import MESHES
from graphface.nodes.pictures.photo import bytes_of
from graphface.nodes.types import Mesh, Texture


def write_mesh(mesh: Mesh, path: Path, texture: Texture | None = None) -> None:
    """Write a mesh in the camera frame, its size that of the face in pixels; PLY carries colors per vertex.

    Raises:
        UsageError: trimesh is missing.
        UnwritableFile: another suffix, or the folder refuses.
    """
    check_mesh_writer(path)
    import trimesh

    path = Path(path)
    if path.suffix.lower() not in MESHES:
        raise UnwritableFile(path, f"a mesh is written as {', '.join(MESHES)}")
    made = trimesh.Trimesh(mesh.vertices, mesh.triangles, vertex_normals=mesh.normals, process=False)
    if texture is not None:
        made.visual = _visual(trimesh, mesh, texture, per_vertex=path.suffix.lower() == ".ply")
    try:
        if path.suffix.lower() == ".obj" and texture is not None:
            _write_obj(trimesh, made, path)
        elif path.suffix.lower() == ".gltf":
            files = trimesh.exchange.gltf.export_gltf(made.scene(), embed_buffers=True)
            path.write_bytes(files["model.gltf"])
        else:
            made.export(path)
    except OSError as error:
        raise UnwritableFile(path, error.strerror or str(error)) from error


def check_mesh_writer(path: Path) -> None:
    """See that meshes can be written here.

    Raises:
        UsageError: trimesh is missing.
    """
    try:
        import trimesh  # noqa: F401 - a package that is there and broken is found too
    except ImportError:
        raise UsageError(f"{path}: writing meshes needs trimesh: pip install 'graphface[models]'") from None


def _visual(trimesh: Any, mesh: Mesh, texture: Texture, *, per_vertex: bool) -> Any:
    import PIL.Image

    uv, pixels = mesh_uv(mesh), bytes_of(texture.image)
    if per_vertex:
        size = pixels.shape[0]
        at = np.clip(np.rint(np.column_stack([uv[:, 0], 1 - uv[:, 1]]) * size - 0.5), 0, size - 1).astype(int)
        return trimesh.visual.ColorVisuals(vertex_colors=pixels[at[:, 1], at[:, 0]])
    material = trimesh.visual.material.SimpleMaterial(image=PIL.Image.fromarray(pixels))
    return trimesh.visual.TextureVisuals(uv=uv, material=material)


def _write_obj(trimesh: Any, made: Any, path: Path) -> None:
    """The OBJ with its material and texture beside it, named after it so that they overwrite no other file."""
    made.visual.material.name = f"{path.stem}_texture"
    text, files = trimesh.exchange.obj.export_obj(made, return_texture=True, mtl_name=f"{path.stem}.mtl")
    path.write_text(text, encoding="utf-8")
    for name, content in files.items():
        path.with_name(name).write_bytes(content)
