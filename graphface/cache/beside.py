"""Files beside the code: they count by their place in the package and by their content, not by where it is installed.

Two environments on one machine, or a container and its host, have the same operators at two paths. A constant like
`Path(__file__).with_name("mean.npz")` must not keep them from sharing results; another `mean.npz` must.
"""

from __future__ import annotations

import ast
import os
from collections.abc import Iterable
from pathlib import Path, PurePath

from graphface.errors import UnreadableFile
from graphface.values.digest import digest_file


def place(path: str | PurePath, folders: Iterable[str]) -> str | None:
    """`path` as seen from the innermost of `folders` that it lies in, with "/" between its parts; None outside all."""
    text = os.fspath(path)
    around = [folder for folder in folders if text == folder or text.startswith(folder + os.sep)]
    return PurePath(text).relative_to(max(around, key=len)).as_posix() if around else None


def content(path: str | Path) -> bytes:
    """The digest of a data file; empty for anything else, and for source code, which counts by what it says."""
    if os.fspath(path).endswith((".py", ".pyc")) or not os.path.isfile(path):
        return b""
    try:
        return digest_file(path)
    except UnreadableFile:
        return b"unreadable"


def named_files(code: ast.AST, module: Path) -> list[Path]:
    """The paths that an expression in the file `module` makes of `__file__`, by the usual steps of pathlib."""
    found = (_path(part, module) for part in ast.walk(code))
    return [path for path in found if path is not None]


def _path(expression: ast.AST, module: Path) -> Path | None:
    match expression:
        case ast.Call(
            func=ast.Name(id="Path") | ast.Attribute(attr="Path"), args=[ast.Name(id="__file__")], keywords=[]
        ):
            return module
        case ast.Attribute(value=inner, attr="parent"):
            base = _path(inner, module)
            return base.parent if base is not None else None
        case ast.Call(func=ast.Attribute(value=inner, attr="resolve" | "absolute"), args=[], keywords=[]):
            return _path(inner, module)
        case ast.Call(func=ast.Attribute(value=inner, attr="with_name"), args=[ast.Constant(value=str(name))]):
            base = _path(inner, module)
            return base.parent / name if base is not None else None
        case ast.BinOp(left=inner, op=ast.Div(), right=ast.Constant(value=str(name))):
            base = _path(inner, module)
            return base / name if base is not None else None
    return None
