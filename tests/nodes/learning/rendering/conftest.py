"""ICT-FaceKit's head for the tests that need one."""

import pytest

from graphface.nodes.learning.rendering.head_model import read_head


@pytest.fixture(scope="session")
def head(shared):
    return read_head(shared / "models" / "ict_facekit.npz")
