"""A graph comes from a file, a text, a mapping or a name, and imports no code."""

from pathlib import Path

import pytest
from graph_texts import SUMS

from graphface import DocumentError, Graph, Registry, UsageError, load


@pytest.fixture
def graph(registry: Registry) -> Graph:
    return load(SUMS, registry=registry)


class TestSources:
    def test_file(self, registry: Registry, tmp_path: Path) -> None:
        """From a file, by path or text of the path."""
        (tmp_path / "g.yaml").write_text(SUMS)
        for source in (tmp_path / "g.yaml", str(tmp_path / "g.yaml")):
            assert load(source, registry=registry).run(["y"])["y"] == 3

    def test_mapping(self, registry: Registry) -> None:
        """From a mapping of the same form; a text in it never becomes a number."""
        settings = {"must": 1, "mode": "1e0"}
        nodes = {
            "x": {"use": "toy.ranged", "in": {"a": "n"}, "with": settings},
            "n": {"use": "toy.number", "with": {"value": 1e-7}},
        }
        tree = {"graphface": 1, "nodes": nodes}
        loaded = load(tree, registry=registry)
        assert {s.name: s.parameters.get("mode") for s in loaded.steps} == {"n": None, "x": "1e0"}
        assert loaded.run(["n"])["n"] == 1e-7

    def test_mapping_of_objects(self, registry: Registry) -> None:
        """A mapping with values that a file could not hold is refused."""
        with pytest.raises(UsageError, match="plain values"):
            load(
                {"graphface": 1, "nodes": {"x": {"use": "toy.number", "with": {"value": object()}}}}, registry=registry
            )

    def test_name_from_the_file(self, registry: Registry, tmp_path: Path) -> None:
        """A graph without a name is called like its file."""
        (tmp_path / "mine.yaml").write_text(SUMS.replace("name: sums\n", ""))
        assert load(tmp_path / "mine.yaml", registry=registry).name == "mine"

    def test_plugin(self, registry: Registry, tmp_path: Path) -> None:
        """Plug-ins of one load do not stay in the registry."""
        (tmp_path / "plug.py").write_text(
            "from graphface import node\n@node('mine.one')\ndef one() -> float:\n    return 1.0\n"
        )
        text = "graphface: 1\nnodes: {o: {use: mine.one}}\n"
        assert load(text, registry=registry, plugins=[tmp_path / "plug.py"]).run(["o"])["o"] == 1
        with pytest.raises(DocumentError):
            load(text, registry=registry)

    def test_cannot_import_code(self, registry: Registry, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
        """A graph file cannot execute code: no name in it is ever imported."""
        (tmp_path / "evil.py").write_text("raise SystemExit('executed')\n")
        monkeypatch.syspath_prepend(str(tmp_path))
        for use in ("evil.run", "evil", "evil:run", "evil.py", "./evil.py"):
            with pytest.raises(DocumentError):
                load(f"graphface: 1\nnodes:\n  x: {{use: '{use}'}}\n", registry=registry)
