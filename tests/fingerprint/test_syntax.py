"""One syntax, one canonical form: on every Python, in every layout."""

import ast
import os
import shutil
import subprocess
import sys
from hashlib import blake2b
from pathlib import Path

import pytest

import graphface
import graphface.nodes
from graphface.fingerprint import syntax as syntax_module
from graphface.fingerprint.syntax import syntax

OTHERS = [version for version in ((3, 11), (3, 12), (3, 13), (3, 14)) if version != sys.version_info[:2]]

PROGRAM = """\
import ast, importlib.util, sys
from hashlib import blake2b
from pathlib import Path
spec = importlib.util.spec_from_file_location("syntax", sys.argv[1])
module = importlib.util.module_from_spec(spec)
spec.loader.exec_module(module)
print(sys.version_info[:2])
for path in sys.stdin.read().split("\\n"):
    print(blake2b(module.syntax(ast.parse(Path(path).read_bytes())), digest_size=8).hexdigest(), path)
"""

HARD = """\
@decorator
async def f(a, /, b: int = 1, *c, d=None, **e) -> "str":
    global g
    match a:
        case {"x": [1, *rest], **more} | C(y=None) as z if z: pass
    return f"{a!r:>{b}.{d}}{b=}{{}}" "ab" rf"\\d{c:}" f"{'x' if a else 'y'}", b"\\xff", 1e999, 1j, ..., "ü\\ud800", 0xff
class C(B, metaclass=M): x: T
lambda *, k=1: (yield), [*{**a, 1: 2}], a[1:2, ...], not a <= b < c, (w := 3), -1 ** 2
try: pass
except* E as e: raise X from None
"""


def _interpreter(version: tuple[int, int]) -> str:
    name = "python" + ".".join(map(str, version))
    pyenv = Path(os.environ.get("PYENV_ROOT", Path.home() / ".pyenv")) / "versions"
    found = [shutil.which(name), *map(str, pyenv.glob(f"{version[0]}.{version[1]}.*/bin/{name}"))]
    for path in filter(None, found):
        run = [path, "-c", "import sys; print(*sys.version_info[:2])"]
        if subprocess.run(run, capture_output=True, text=True).stdout.split() == list(map(str, version)):
            return path
    pytest.skip(f"no {name} here")


@pytest.mark.parametrize("version", OTHERS, ids=lambda v: f"{v[0]}.{v[1]}")
def test_other_interpreters(version, tmp_path):
    """Every module of this distribution, and a file of hard cases, has the same form on another Python."""
    python = _interpreter(version)
    (tmp_path / "hard.py").write_text(HARD, encoding="utf-8")
    packages = (Path(graphface.__file__).parent, Path(graphface.nodes.__file__).parent)
    paths = [tmp_path / "hard.py", *sorted(path for package in packages for path in package.rglob("*.py"))]
    run = [python, "-I", "-c", PROGRAM, syntax_module.__file__]
    answer = subprocess.run(run, input="\n".join(map(str, paths)), capture_output=True, text=True, check=True)
    first, *lines = answer.stdout.splitlines()
    assert first == str(version)
    ours = [f"{blake2b(syntax(ast.parse(p.read_bytes())), digest_size=8).hexdigest()} {p}" for p in paths]
    assert lines == ours


class TestWhatCounts:
    @pytest.mark.parametrize(
        ("one", "other"),
        [
            ("x = 1", "x = True"),
            ("x = 1", "x = 1.0"),
            ("x = 'a'", "x = b'a'"),
            ("x = 'é'", "x = 'e\u0301'"),
            ("f(a, b)", "f(a, c)"),
            ("f(a)(b)", "f(a, b)"),
            ("a - (b - c)", "a - b - c"),
            ("def f(*, a, b=1): 0", "def f(*, a=1, b): 0"),
            ("{**a, 1: 2}", "{1: 2, **a}"),
            ("f'{a}b'", "f'{a}{b}'"),
            ("f'{a!r}'", "f'{a}'"),
            ("if a: pass\nb", "if a:\n    pass\n    b"),
            ("global a\nglobal b", "global a, b"),
            ("from . import a", "from .. import a"),
            ("x: int = 1", "x = 1"),
            ("async def f(): pass", "def f(): pass"),
            ("if TYPE_CHECKING: a\nelse: b", "if TYPE_CHECKING: a\nelse: c"),
        ],
    )
    def test_differs(self, one, other):
        """Whatever can change a result changes the form."""
        assert syntax(ast.parse(one)) != syntax(ast.parse(other))

    @pytest.mark.parametrize(
        ("one", "other"),
        [
            ("x = 'a'", 'x  =  """a"""  # why'),
            ("x = 'a' 'b'", "x = 'ab'"),
            ("f(a, b,)", "f(\n    a,\n    (b)\n)"),
            ("def f():\n    'doc'\n    return 1", "def f(): return 1"),
            ("x = 1\n'doc'", "x = 1"),
            ("x = 0x10", "x = 16"),
            ("if TYPE_CHECKING:\n    import a\nx = 1", "x = 1"),
            ("u'a'.b", "'a'.b"),
        ],
    )
    def test_agrees(self, one, other):
        """Layout, spelling and documentation do not."""
        assert syntax(ast.parse(one)) == syntax(ast.parse(other))

    def test_depth(self):
        """An expression may be nested as deeply as Python parses it."""
        assert syntax(ast.parse("x = " + " + ".join(["1"] * 900)))
