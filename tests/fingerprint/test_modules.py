"""Which modules count by content, and where they are."""

import sys
from importlib import metadata

import pytest

from graphface.fingerprint.modules import absolute, distribution, imported, locate, released


class TestReleased:
    @pytest.mark.parametrize(
        ("module", "package"), [("cv2", "opencv-contrib-python-headless"), ("PIL.Image", "pillow")]
    )
    def test_another_name(self, module, package):
        """A package whose distribution has another name than its modules counts by the version of that."""
        assert released(module, "") == f"{module.partition('.')[0]} {metadata.version(package)}"

    @pytest.mark.parametrize("module", ["os.path", "builtins", "graphface", "graphface.values"])
    def test_neither(self, module):
        """The standard library and the engine count in no way."""
        assert released(module, "graphface.nodes") == ""

    def test_content(self, tmp_path, monkeypatch):
        """The own distribution, wherever it is installed, and what no installer put there."""
        (tmp_path / "loose_module.py").touch()
        monkeypatch.syspath_prepend(tmp_path)
        assert released("graphface.nodes.types", "graphface.nodes") is None
        assert released("numpy.linalg", "numpy") is None
        assert released("loose_module", "numpy") is None

    def test_distribution(self):
        """The face operators are no part of the engine."""
        names = ("graphface.nodes.types", "graphface.nodes", "graphface.node", "numpy.linalg")
        assert [distribution(name) for name in names] == ["graphface.nodes", "graphface.nodes", "graphface", "numpy"]


class TestLocate:
    def test_not_imported(self, tmp_path, monkeypatch):
        """Modules are found in packages, in namespaces without `__init__`, and none of them is imported."""
        for name in ("located/__init__.py", "located/inner/deep.py"):
            (tmp_path / name).parent.mkdir(exist_ok=True)
            (tmp_path / name).write_text("raise RuntimeError")
        monkeypatch.syspath_prepend(tmp_path)
        assert locate("located") == tmp_path / "located/__init__.py"
        assert locate("located.inner.deep") == tmp_path / "located/inner/deep.py"
        assert "located" not in sys.modules

    @pytest.mark.parametrize(
        "name", ["", ".", "a..b", "no_such_module", "no_such_module.inner", "sys", "numpy.no_such"]
    )
    def test_nowhere(self, name):
        """What has no file is None, and no error."""
        assert locate(name) is None


class TestImported:
    def test_names(self):
        """A name may be a module; if any is not, the package itself is read too."""
        own = "graphface.nodes"
        assert imported(own, ["types"], own) == [f"{own}.types"]
        assert imported(own, ["types", "pack"], own) == [f"{own}.types", own]
        assert imported(f"{own}.types", ["Image"], own) == [f"{own}.types"]
        assert imported(f"{own}.types", [], own) == [f"{own}.types"]

    def test_of_others(self):
        """Of a released package, what is imported does not matter; the engine's package holds the operators."""
        assert imported("scipy", ["ndimage"], "graphface.nodes") == ["scipy"]
        assert imported("graphface", ["nodes"], "graphface.nodes") == ["graphface.nodes"]

    def test_relative(self):
        """Relative names are resolved; where there is no package, nothing breaks."""
        assert absolute("..c.d", "a.b") == "a.c.d"
        assert absolute("c", "a.b") == "c"
        assert absolute(".c", "") == "c"
