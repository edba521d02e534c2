"""Graph files in a folder of their own, loaded with the toy operators."""

from collections.abc import Callable
from pathlib import Path

import pytest

from graphface import Graph, Registry, load

Write = Callable[..., Path]


@pytest.fixture
def write(tmp_path: Path) -> Write:
    """Writes graph files, without the first line that all have."""

    def write_file(name: str, text: str) -> Path:
        path = tmp_path / name
        path.parent.mkdir(exist_ok=True, parents=True)
        path.write_text("graphface: 1\n" + text)
        return path

    return write_file


@pytest.fixture
def opened(registry: Registry) -> Callable[..., Graph]:
    return lambda path, **choices: load(path, registry=registry, **choices)
