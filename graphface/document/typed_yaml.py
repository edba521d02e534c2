"""YAML files and mappings as pydantic models: what a pack needs for file types of its own.

    class Palette(BaseModel):
        colors: tuple[Color, ...]

    def read_palette(path: Path) -> Palette:
        return read_yaml(path, Palette)

    PALETTE = Files(read=read_palette)  # named in the pack's `files`

Such a file is read as graph files are: YAML 1.2 with positions, all mistakes at once, each with file, line, column, the
text with a caret, and the nearest valid name.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any, TypeVar

from pydantic import BaseModel

from graphface.document.located import file_source, parse, plain
from graphface.document.mistakes import mistakes
from graphface.errors import DocumentError

MAX_BYTES = 1 << 18
"""Of a file: such files are written by hand, and read before anything runs."""

Model = TypeVar("Model", bound=BaseModel)


def read_yaml(path: Path | str, model: type[Model]) -> Model:
    """The content of a YAML file as a pydantic model.

    Raises:
        UnreadableFile: there is no such file, it is larger than `MAX_BYTES`, or it is not UTF-8 text.
        DocumentError: it is not YAML, or not what the model asks for; with all mistakes.
    """
    source = file_source(Path(path), MAX_BYTES)
    tree, problems = parse(source)
    problems += mistakes(tree, model, source.start)
    if problems:
        raise DocumentError(problems)
    return model.model_validate(plain(tree))


def validated(value: Any, model: type[Model]) -> Model:
    """A mapping as a pydantic model; what is one already stays as it is.

    Raises:
        DocumentError: it is not what the model asks for; with all mistakes, and their places where the mapping comes
            from a graph file.
    """
    if isinstance(value, model):
        return value
    problems = mistakes(value, model)
    if problems:
        raise DocumentError(problems)
    return model.model_validate(plain(value))
