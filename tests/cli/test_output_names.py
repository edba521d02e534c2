"""What `-o` says: an output, or any node, and its file."""

from pathlib import Path

import pytest

from graphface import Graph, Registry, load
from graphface.cli.output_names import check_apart, check_kept, output_files
from graphface.errors import UsageError

TEXT = "graphface: 1\nname: two\nnodes: {a: {use: toy.number}, b: {use: toy.number}}\noutputs: {first: a, second: b}\n"


@pytest.fixture
def graph(registry: Registry) -> Graph:
    return load(TEXT, registry=registry)


class TestOutputFiles:
    def test_names(self, graph: Graph) -> None:
        """A bare file is the first output; others are named."""
        files = output_files(graph, ["x.npz", "second=y.npz"], {})
        assert files == {"first": Path("x.npz"), "second": Path("y.npz")}

    def test_filled(self, graph: Graph) -> None:
        """{input} is the name of its file, without folder and suffix, and never leads out of the folder."""
        files = output_files(graph, ["out/{photo}-{other}.png"], {"photo": "a/b.c.jpg", "other": "../..evil/.x"})
        assert files == {"first": Path("out/b.c-x.png")}

    @pytest.mark.parametrize(
        ("asked", "said"),
        [
            ([], "outputs: first, second"),
            (["first=a", "b"], "asked for twice"),
            (["=a"], "expected FILE or NAME=FILE"),
            (["{nobody}.png"], "no input 'nobody' was given"),
        ],
    )
    def test_refused(self, graph: Graph, asked: list[str], said: str) -> None:
        """What cannot be meant is refused in a sentence."""
        with pytest.raises(UsageError, match=said):
            output_files(graph, asked, {})


def test_check_apart(tmp_path: Path) -> None:
    """Two results never share a file, under whatever names."""
    (tmp_path / "link.png").symlink_to(tmp_path / "a.png")
    for other in ("a.png", "x/../a.png", "link.png"):
        with pytest.raises(UsageError, match=r"output 'one' and --trace would be written to this one file"):
            check_apart([("output 'one'", tmp_path / "a.png"), ("--trace", tmp_path / other)])
    check_apart([("one", tmp_path / "a.png"), ("two", tmp_path / "b.png")])


def test_check_kept(tmp_path: Path) -> None:
    """A result never takes the place of a file that was given, under whatever name."""
    with pytest.raises(UsageError, match="is an input"):
        check_kept([tmp_path / "x" / ".." / "a.png"], [str(tmp_path / "a.png")])
    check_kept([tmp_path / "b.png"], [str(tmp_path / "a.png")])
