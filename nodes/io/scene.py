"""Scene files: YAML to a scene, with the line of whatever is wrong."""

from __future__ import annotations

from pathlib import Path
from typing import Any, TypeVar

from pydantic import BaseModel, ValidationError

from graphface import UnreadableFile
from graphface.nodes.types.scene import first_problem

M = TypeVar("M", bound=BaseModel)


def read_scene(path: Path, model: type[M]) -> M:
    """The content of a YAML file as `model`.

    Raises:
        UnreadableFile: not readable, not YAML, or not a scene; with the line and what was expected.
    """
    import yaml

    try:
        text = path.read_text(encoding="utf-8")
        tree = yaml.compose(text, Loader=yaml.SafeLoader)
        content = yaml.safe_load(text)
    except OSError as error:
        raise UnreadableFile(path, error.strerror or "cannot be read") from None
    except UnicodeDecodeError:
        raise UnreadableFile(path, "is not a text file; a scene is a YAML file") from None
    except RecursionError:
        raise UnreadableFile(path, "is nested too deeply for a scene") from None
    except yaml.YAMLError as error:
        mark = getattr(error, "problem_mark", None)
        raise UnreadableFile(_at(path, mark), f"not YAML: {getattr(error, 'problem', error)}") from None
    if not isinstance(content, dict):
        raise UnreadableFile(path, "a scene is a mapping with keys such as lights, ambient and mode")
    try:
        return model.model_validate(content)
    except ValidationError as error:
        place, message = first_problem(error)
        name = ".".join(map(str, place))
        raise UnreadableFile(_at(path, _mark(tree, place)), f"{name}: {message}" if name else message) from None


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
