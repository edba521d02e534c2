"""What the README shows is true: its example of an operator is run as it stands."""

import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from graphface import load
from graphface.nodes.types import Image
from graphface.testing import check_node

README = Path(__file__).resolve().parents[1] / "README.md"


def example(language: str) -> str:
    """The first block of a language after the words "a complete operator"."""
    after = README.read_text(encoding="utf-8").partition("a complete operator")[2]
    found = re.search(rf"```{language}\n(.*?)```", after, re.DOTALL)
    assert found is not None, f"README.md has no {language} block after 'a complete operator'"
    return found[1]


@pytest.fixture
def operator() -> Any:
    """The example's operator, as Python finds it."""
    namespace: dict[str, Any] = {"__name__": "readme_example"}
    exec(compile(example("python"), "README.md", "exec"), namespace)
    (found,) = (value for value in namespace.values() if hasattr(value, "__graphface_operator__"))
    return found


def photo() -> Image:
    return Image(np.random.default_rng(0).random((24, 20, 3)).astype(np.float32))


class TestOperator:
    def test_length(self) -> None:
        """It is complete in fewer than 20 lines."""
        assert len([line for line in example("python").splitlines() if line.strip()]) < 20

    def test_promises(self, operator: Any) -> None:
        """It passes the check that the README recommends."""
        out = check_node(operator, photo(), sigma=2.0)
        assert out.pixels.std() < photo().pixels.std()

    def test_as_plugin(self, tmp_path: Path) -> None:
        """Saved to a file it is a plug-in, and the README's graph loads with it."""
        (tmp_path / "smooth.py").write_text(example("python"), encoding="utf-8")
        (tmp_path / "smooth.yaml").write_text(example("yaml"), encoding="utf-8")
        graph = load(tmp_path / "smooth.yaml", plugins=[tmp_path / "smooth.py"])
        assert "image" in graph.outputs
        text = "graphface: 1\ninputs: {photo: Image}\nnodes: {n: {use: retouch.smooth, in: {photo: photo}}}\n"
        alone = load(text, plugins=[tmp_path / "smooth.py"])
        assert alone.run(["n"], photo=photo())["n"].pixels.shape == (24, 20, 3)
