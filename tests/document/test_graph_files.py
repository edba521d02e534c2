"""Where graph files are, and what they cannot name."""

from collections.abc import Callable
from pathlib import Path

import pytest
from graph_texts import ADD, refused

from graphface import Graph, Registry, UnreadableFile, load
from graphface.document.graph_files import find_graph
from graphface.fallback import GraphfaceWarning

Write = Callable[..., Path]


class TestFiles:
    @pytest.mark.parametrize("name", ["../secret.yaml", "sub/../../secret.yaml"])
    def test_outside(self, tmp_path: Path, write: Write, opened: Callable[..., Graph], name: str) -> None:
        """A graph file cannot use or extend a file outside the folder of the graph that was asked for."""
        (tmp_path / "graphs" / "sub").mkdir(parents=True)
        write("secret.yaml", ADD)
        for text in (f"nodes: {{x: {{use: {name}}}}}\n", f"extends: {name}\n"):
            problem, *_ = refused(opened, write("graphs/g.yaml", text))
            assert "outside" in problem.message

    def test_absolute(self, tmp_path: Path, write: Write, opened: Callable[..., Graph]) -> None:
        """Nor by its absolute path."""
        secret = write("secret.yaml", ADD)
        problem, *_ = refused(opened, write("graphs/g.yaml", f"nodes: {{x: {{use: {secret}}}}}\n"))
        assert "outside" in problem.message

    def test_link(self, tmp_path: Path, write: Write, opened: Callable[..., Graph]) -> None:
        """Nor through a link that lies inside."""
        secret = write("secret.yaml", ADD)
        graph = write("graphs/g.yaml", "nodes: {x: {use: link.yaml}}\n")
        (tmp_path / "graphs" / "link.yaml").symlink_to(secret)
        problem, *_ = refused(opened, graph)
        assert "outside" in problem.message

    def test_flag_cannot_reach_outside_either(self, write: Write, opened: Callable[..., Graph]) -> None:
        """`--replace` names graph files under the same rule."""
        write("secret.yaml", ADD)
        graph = write("graphs/g.yaml", ADD)
        problem, *_ = refused(opened, graph, replace={"x": "../secret.yaml"})
        assert "outside" in problem.message

    @pytest.mark.parametrize("name", ['"a\\0.yaml"', "x" * 5000 + ".yaml", '"\\n.yaml"', ".yaml", "/.yaml"])
    def test_impossible_name(self, write: Write, opened: Callable[..., Graph], name: str) -> None:
        """A name that no file can have is a file that does not exist."""
        for text in (f"nodes: {{x: {{use: {name}}}}}\n", f"extends: {name}\n"):
            problem, *_ = refused(opened, write("g.yaml", text))
            assert "no graph file" in problem.message

    @pytest.mark.parametrize("name", ["nowhere", "a\0b", "x" * 5000])
    def test_unknown_graph(self, registry: Registry, name: str) -> None:
        """A graph that is neither a file nor shipped is named."""
        with pytest.raises(UnreadableFile):
            load(name, registry=registry)

    def test_shadowed(self, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
        """A bare name is the shipped graph, with a warning where a file here has it; a path or a suffix is the file."""
        (tmp_path / "shipped").mkdir()
        for name in ("relight", "relight.yaml", "shipped/relight.yaml"):
            (tmp_path / name).touch()
        monkeypatch.chdir(tmp_path)
        shipped = [tmp_path / "shipped"]
        with pytest.warns(GraphfaceWarning, match=r"shipped graph; .* \./relight"):
            assert find_graph("relight", shipped) == tmp_path / "shipped" / "relight.yaml"
        for name in ("./relight", "relight.yaml", str(tmp_path / "relight")):
            assert find_graph(name, shipped) == Path(name)

    def test_broken_inner_file(self, write: Write, opened: Callable[..., Graph]) -> None:
        """A problem inside a used file is told with its place in that file."""
        write("bad.yaml", "nodes: {x: 3}\n")
        found = refused(opened, write("g.yaml", "nodes: {x: {use: bad.yaml}}\n"))
        assert found[0].place is not None
        assert found[0].place.source.name.endswith("bad.yaml")
