"""Every type that has files is found by them, and what is promised of suffixes holds."""

from __future__ import annotations

import pytest

from graphface import Files
from graphface.nodes import pack
from graphface.registry import default_registry


@pytest.mark.parametrize("name", pack.files)
def test_found(name: str) -> None:
    """A port of the type has the files that the pack names."""
    registry = default_registry()
    found = registry.files(registry.type(name))
    assert isinstance(found, Files)
    assert found in registry.all_files()


def test_suffixes_of_pictures() -> None:
    """The suffixes that picture types promise are those that pictures are written as."""
    from graphface.nodes.io.image_write import SUFFIXES
    from graphface.nodes.io.suffixes import PICTURES

    assert set(SUFFIXES) == set(PICTURES)
