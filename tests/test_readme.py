"""What the README shows is true: its example of an operator is run as it stands, as a file and as a package."""

import os
import re
import subprocess
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from graphface import DocumentError, load
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
        (tmp_path / "retouch.py").write_text(example("python"), encoding="utf-8")
        (tmp_path / "smooth.yaml").write_text(example("yaml"), encoding="utf-8")
        graph = load(tmp_path / "smooth.yaml", plugins=[tmp_path / "retouch.py"])
        assert "image" in graph.outputs
        text = "graphface: 1\ninputs: {photo: Image}\nnodes: {n: {use: retouch.smooth, in: {photo: photo}}}\n"
        alone = load(text, plugins=[tmp_path / "retouch.py"])
        assert alone.run(["n"], photo=photo())["n"].pixels.shape == (24, 20, 3)


class TestPackage:
    def test_installed(self, tmp_path: Path) -> None:
        """With the README's pyproject.toml its operator is found like an installed one."""
        pytest.importorskip("setuptools", reason="builds the package's metadata")
        (tmp_path / "retouch.py").write_text(example("python"), encoding="utf-8")
        (tmp_path / "pyproject.toml").write_text(example("toml"), encoding="utf-8")
        # What an editable install does, without pip: the metadata beside the module, and the folder on the path.
        build = [sys.executable, "-c", "import setuptools; setuptools.setup()", "-q", "egg_info"]
        subprocess.run(build, cwd=tmp_path, check=True, capture_output=True, timeout=60)
        program = "from graphface.cli import main; main(['nodes', 'retouch.smooth'])"
        paths = os.pathsep.join([str(tmp_path), *filter(None, sys.path)])
        done = subprocess.run(
            [sys.executable, "-c", program],
            cwd=tmp_path.parent,
            env={**os.environ, "PYTHONPATH": paths},
            capture_output=True,
            text=True,
            timeout=60,
        )
        assert (done.returncode, done.stderr) == (0, "")
        assert "Blur a photo; sigma in pixels." in done.stdout


class TestScene:
    def test_error(self, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
        """A wrong scene is told what the README shows."""
        monkeypatch.chdir(tmp_path)
        lines = ["doc: Lamps.", "ambient: 0.1", "lights:", "  - {type: spott, azimuth: 60, cone: 120}"]
        Path("night.yaml").write_text("\n".join(lines))
        with pytest.raises(DocumentError) as caught:
            load("relight").bind({"scene": "night.yaml"})
        shown = "".join(f"    {line}\n" for line in f"error: {caught.value}".splitlines())
        assert shown in README.read_text(encoding="utf-8")
