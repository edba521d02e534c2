"""What all commands share, and commands of packs."""

import json
from collections.abc import Callable
from pathlib import Path

import pytest

from graphface import __version__

RENAMED = """
from typing import Annotated
from graphface import Formerly, node

@node("mine.new", formerly=("mine.old",))
def new(a: float, *, by: Annotated[float, Formerly("factor")] = 2) -> float:
    \"\"\"Multiply.\"\"\"
    return a * by
"""

HEAVY = ("numpy", "networkx", "cv2", "scipy", "yaml", "PIL", "skimage", "sklearn")


class TestLight:
    @pytest.mark.parametrize(
        "program",
        [
            "import graphface",
            "import graphface.nodes",
            "from graphface.cli import main\ntry: main(['--help'])\nexcept SystemExit: pass",
            "from graphface.cli import main\ntry: main(['--version'])\nexcept SystemExit: pass",
            "from graphface.cli import main\ntry: main(['run', '--help'])\nexcept SystemExit: pass",
        ],
    )
    def test_imports(self, process: Callable[..., object], program: str) -> None:
        """Importing the package, and help, load no library of arrays, graphs or validation."""
        done = process(f"{program}\nimport sys\nprint('loaded:', *[m for m in {HEAVY!r} if m in sys.modules])")
        assert done.returncode == 0
        assert done.stdout.splitlines()[-1].strip() == "loaded:"

    def test_package_alone(self, process: Callable[..., object]) -> None:
        """Importing the package loads no pydantic either (the command line's own library may)."""
        done = process("import graphface, graphface.nodes, sys; assert 'pydantic' not in sys.modules")
        assert done.returncode == 0, done.stderr

    def test_networkx_is_not_needed_to_run(self, process: Callable[..., object]) -> None:
        """Loading and running a graph without a cycle does not import networkx."""
        text = "graphface: 1\\ninputs: {x: float}\\noutputs: {y: x}\\n"
        done = process(
            f"import sys, graphface\nassert graphface.load('{text}').run(x=1.0)['y'] == 1\n"
            "assert 'networkx' not in sys.modules"
        )
        assert done.returncode == 0, done.stderr


class TestTop:
    def test_version(self, graphface: Callable[..., object]) -> None:
        """`--version` says the version."""
        said = graphface("--version")
        assert (said.code, said.out.strip()) == (0, f"graphface {__version__}")

    def test_help(self, graphface: Callable[..., object]) -> None:
        """`--help` lists the commands."""
        said = graphface("--help")
        assert said.code == 0
        for command in ("run", "plan", "nodes", "assets"):
            assert command in said.out

    def test_no_arguments(self, graphface: Callable[..., object]) -> None:
        """Without arguments the help is shown."""
        said = graphface()
        assert said.code in (0, 2)
        assert "Usage" in said.out + said.err

    def test_unknown_command(self, graphface: Callable[..., object]) -> None:
        """An unknown command is a wrong request."""
        said = graphface("rum")
        assert said.code == 2
        assert "rum" in said.err

    def test_internal_error(self, graphface: Callable[..., object], monkeypatch: pytest.MonkeyPatch) -> None:
        """A mistake of the program itself is one line that says how to see more."""

        def broken(*_: object, **__: object) -> None:
            raise KeyError("oops")

        monkeypatch.setattr("graphface.facade.load", broken)
        said = graphface("plan", "x.yaml")
        assert said.code == 1
        assert "GRAPHFACE_TRACEBACK" in said.err
        assert len(said.err.strip().splitlines()) == 1


class TestEveryCommand:
    @pytest.mark.parametrize("command", ["plan", "show", "explain"])
    def test_wrong_graph(self, graphface: Callable[..., object], tmp_path: Path, command: str) -> None:
        """Every command that takes a graph answers a wrong one alike."""
        path = tmp_path / "bad.yaml"
        path.write_text("graphface: 1\nnodes: {x: 3}\n")
        said = graphface(command, path)
        assert said.code == 2
        assert "bad.yaml:2:12" in said.err

    def test_schema_is_json(self, graphface: Callable[..., object]) -> None:
        """`schema` prints JSON."""
        said = graphface("schema")
        assert said.code == 0
        assert json.loads(said.out)


class TestOldNames:
    @pytest.fixture
    def renamed(self, tmp_path: Path) -> Path:
        path = tmp_path / "renamed.py"
        path.write_text(RENAMED)
        return path

    def test_graph(self, graphface: Callable[..., object], renamed: Path, tmp_path: Path) -> None:
        """Old names in a file and in a flag are a line each on standard error, with their place."""
        graph = tmp_path / "g.yaml"
        graph.write_text(
            "graphface: 1\ninputs: {x: {type: float, default: 2}}\nnodes: {n: {use: mine.old, in: {a: x}}}\n"
        )
        said = graphface("show", graph, "--plugin", renamed, "--set", "n.factor=3")
        assert said.code == 0
        assert said.err.splitlines() == [
            f"warning: {graph}:3:18: operator 'mine.old' is now called 'mine.new'",
            "warning: --set:1:1: parameter 'factor' of mine.new is now called 'by'",
        ]

    def test_nodes(self, graphface: Callable[..., object], renamed: Path) -> None:
        """`nodes` shows an operator under its old name, and what its old names are."""
        said = graphface("nodes", "mine.old", "--plugin", renamed)
        assert said.code == 0
        assert said.err == "warning: operator 'mine.old' is now called 'mine.new'\n"
        assert "old names: mine.old, factor (now by)" in said.out


class TestCommandsOfPacks:
    @pytest.fixture
    def offered(self, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
        """A distribution with commands of every kind, good and broken."""
        monkeypatch.syspath_prepend(tmp_path)
        folder = tmp_path / "extras-2.0.dist-info"
        folder.mkdir()
        (folder / "METADATA").write_text("Metadata-Version: 2.1\nName: extras\nVersion: 2.0\n")
        (folder / "entry_points.txt").write_text(
            "[graphface.commands]\ngood = extras_good:good\nmany = extras_good:app\nrun = extras_good:good\n"
            "text = extras_good:TEXT\nodd = extras_good:odd\nbad = extras_bad:command\n"
        )
        (tmp_path / "extras_good.py").write_text(
            "import typer\napp = typer.Typer(help='Two of them.')\nTEXT = 'no command'\n\n"
            "@app.command()\ndef one() -> None:\n    print('one')\n\n"
            'def good(word: str = \'well\') -> None:\n    """Says a word."""\n    print(word)\n\n'
            "def odd(what: 'Odd') -> None:\n    pass\n"
        )
        (tmp_path / "extras_bad.py").write_text("import not_there\n")

    @pytest.mark.usefixtures("offered")
    def test_good(self, graphface: Callable[..., object]) -> None:
        """A function is a command, a `typer.Typer` a group of them."""
        assert graphface("good", "--word", "fine").out == "fine\n"
        assert graphface("many", "one").out == "one\n"

    @pytest.mark.usefixtures("offered")
    def test_broken(self, graphface: Callable[..., object]) -> None:
        """Broken ones are told in a line each and left out; help and the engine's commands work."""
        said = graphface("--help")
        assert said.code == 0
        assert "Says a word." in said.out
        assert "Run a graph" in said.out
        told = {line.partition(" (")[0].rpartition(" ")[2]: line for line in said.err.splitlines()}
        assert set(told) == {"'bad'", "'odd'", "'run'", "'text'"}
        assert told["'bad'"].startswith(
            "warning: extras 2.0: graphface.commands entry 'bad' (extras_bad:command) is left"
        )
        assert "No module named 'not_there'" in told["'bad'"]
        assert "there is a command of this name already" in told["'run'"]
        assert "it is a str, no command" in told["'text'"]
        assert "Odd" in told["'odd'"]
