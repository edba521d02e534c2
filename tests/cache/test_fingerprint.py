"""A fingerprint changes with everything a result depends on in the code, and with nothing else.

Each case writes a small package, fingerprints its operator, writes an edited copy and compares.
"""

import argparse
import dis
import itertools
import json
import random
import subprocess
import sys
import tokenize
from collections.abc import Callable, Iterator
from io import StringIO
from types import CodeType, ModuleType

import pytest

from graphface.cache.bytecode import instructions, read_code
from graphface.cache.fingerprint import Fingerprint, fingerprint

PACKAGE = {
    "__init__.py": "",
    "blur.py": '''
"""Blurring."""
import functools
from dataclasses import dataclass
import numpy as np
from probe_pack import kernels
from probe_pack.tables import LUT, Table
from probe_pack.tables import scaled as resized

SCALE = 2
WEIGHTS = {"a": (1, 2), "b": np.arange(3)}

def traced(function):
    @functools.wraps(function)
    def wrapper(*args, **kwargs):
        return function(*args, **kwargs)
    return wrapper

@traced
def blur(x, *, sigma=1.0):
    """Blur."""
    from probe_pack.lazy import finish
    y = kernels.gauss(x, sigma) * SCALE + len(WEIGHTS)
    return finish(Table(y).read(LUT)) + resized(x)

def needs(sigma):
    return {"x": sigma > 0}

def unrelated():
    return 1
''',
    "kernels.py": """
from probe_pack.deep import normal

def gauss(x, sigma):
    return normal(x) / sigma
""",
    "deep.py": """
def normal(x, floor=1e-6):
    # keep away from zero
    return max(x, floor) if x not in {"a", "b", "c"} else 0
""",
    "tables.py": """
from dataclasses import dataclass
from functools import lru_cache

LUT = [1, 2, 3]

@dataclass(frozen=True)
class Table:
    value: float
    step: int = 1

    def read(self, lut):
        return self.value + lut[self.step] * self.size

    @property
    def size(self):
        return 3

    @staticmethod
    def from_file(path):
        return Table(float(path.read_text()))

@lru_cache
def scaled(x):
    return x * 4
""",
    "lazy.py": """
import math
from probe_pack.last import step

AMOUNT = 5

def finish(y):
    return step(y) + AMOUNT

def unused(y):
    return y
""",
    "last.py": "def step(y):\n    return y + 1\n",
}

Edits = dict[str, tuple[str, str]]
Load = Callable[..., ModuleType]


@pytest.fixture
def load(tmp_path, monkeypatch) -> Iterator[Load]:
    """Writes the package with edits {file: (old, new)} into a folder of its own, and imports its `blur` module."""
    numbers = itertools.count()

    def unload() -> None:
        for name in [n for n in sys.modules if n.partition(".")[0] == "probe_pack"]:
            del sys.modules[name]

    def load(edits: Edits | None = None, operator: str = "blur") -> ModuleType:
        unload()
        folder = tmp_path / str(next(numbers))
        (folder / "probe_pack").mkdir(parents=True)
        for name, text in PACKAGE.items():
            old, new = (edits or {}).get(name, ("", ""))
            assert old in text
            (folder / "probe_pack" / name).write_text(text.replace(old, new, 1) if old else text)
        monkeypatch.syspath_prepend(folder)
        return __import__(f"probe_pack.{operator}", fromlist=["_"])

    yield load
    unload()


def of(module: ModuleType) -> Fingerprint:
    return fingerprint(module.blur, module.needs)


class TestChanges:
    @pytest.mark.parametrize(
        ("file", "old", "new"),
        [
            pytest.param("blur.py", "len(WEIGHTS)", "2 * len(WEIGHTS)", id="body"),
            pytest.param("blur.py", "sigma=1.0", "sigma=2.0", id="default"),
            pytest.param("blur.py", "sigma > 0", "sigma > 1", id="needs rule"),
            pytest.param("blur.py", "return function(", "return 2 * function(", id="decorator"),
            pytest.param("blur.py", "SCALE = 2", "SCALE = 3", id="constant"),
            pytest.param("blur.py", "SCALE = 2", "SCALE = 2.0", id="constant of another type"),
            pytest.param("blur.py", "np.arange(3)", "np.arange(4)", id="array in a constant"),
            pytest.param("kernels.py", "/ sigma", "* sigma", id="helper"),
            pytest.param("deep.py", "max(x, floor)", "min(x, floor)", id="helper of a helper"),
            pytest.param("deep.py", "1e-6", "1e-5", id="default of a helper's helper"),
            pytest.param("deep.py", '"b"', '"d"', id="set in a helper's helper"),
            pytest.param("tables.py", "[1, 2, 3]", "[1, 2, 4]", id="imported constant"),
            pytest.param("tables.py", "self.value + lut", "self.value - lut", id="method"),
            pytest.param("tables.py", "return 3", "return 4", id="property"),
            pytest.param("tables.py", "step: int = 1", "step: int = 2", id="dataclass default"),
            pytest.param("tables.py", "x * 4", "x * 5", id="cached function"),
            pytest.param("lazy.py", "step(y) +", "step(y) -", id="function imported late"),
            pytest.param("lazy.py", "AMOUNT = 5", "AMOUNT = 6", id="constant of a late import"),
            pytest.param("last.py", "y + 1", "y + 2", id="helper of a late import"),
        ],
    )
    def test_an_edit_that_matters(self, load, file, old, new):
        """Whatever the operator reaches counts, in any module of its distribution."""
        assert of(load()).digest != of(load({file: (old, new)})).digest

    @pytest.mark.parametrize(
        ("file", "old", "new"),
        [
            pytest.param("blur.py", '"""Blur."""', '"""Blur, in other words.\n\n    And more."""', id="docstring"),
            pytest.param("blur.py", '    """Blur."""\n', "", id="no docstring"),
            pytest.param("blur.py", "    y = kernels", "    # why\n\n    y = kernels", id="comment"),
            pytest.param("blur.py", "SCALE = 2", "\n\n\n# twice\nSCALE = 2", id="line numbers"),
            pytest.param("blur.py", "return 1", "return 2", id="unrelated function"),
            pytest.param("deep.py", "# keep away from zero", "# floor", id="comment in a helper"),
            pytest.param("deep.py", '"a", "b", "c"', '"c", "b", "a"', id="order of a set"),
            pytest.param("lazy.py", "AMOUNT = 5", "# five\n\nAMOUNT = 5", id="comment in a late import"),
            pytest.param("lazy.py", "return y\n", "return -y\n", id="unused function of a late import"),
            pytest.param("tables.py", "float(path", "int(path", id="hook of the engine that nobody names"),
        ],
    )
    def test_an_edit_that_does_not(self, load, file, old, new):
        """Comments, docstrings, positions and code that is not reached do not count."""
        assert of(load()).digest == of(load({file: (old, new)})).digest

    def test_a_hook_that_is_named(self, load):
        """`from_file` counts for an operator that calls it."""
        calls = ("Table(y)", "Table.from_file(y)")
        before = of(load({"blur.py": calls}))
        after = of(load({"blur.py": calls, "tables.py": ("float(path", "int(path")}))
        assert before.digest != after.digest

    def test_a_class_made_by_a_function(self):
        """Neither its docstring nor the line it stands on counts; what it says does."""
        plain = "def f():\n    class C:\n        a = 1\n    return C"
        documented = plain.replace("class C:", '# a remark\n    class C:\n        """What it is."""')
        assert _cell(plain) == _cell(documented) != _cell(plain.replace("a = 1", "a = 2"))

    def test_lambdas_from_outside(self, load, monkeypatch):
        """Two different functions patched in from unreleased code give two digests."""
        module = load()
        digests = set()
        for replacement in (lambda x, s: x, lambda x, s: x + 1):
            monkeypatch.setattr(module.kernels, "gauss", replacement)
            digests.add(of(module).digest)
        assert len(digests) == 2

    def test_recursion_ends(self):
        """Functions that call each other have a fingerprint."""
        assert len(fingerprint(_even).digest) == 16

    def test_lists_what_was_reached(self, load):
        """`reached` names helpers, classes and released packages with their versions."""
        import numpy as np

        reached = of(load()).reached
        assert {"probe_pack.kernels.gauss", "probe_pack.deep.normal", "probe_pack.tables.Table"} <= set(reached)
        assert "probe_pack.lazy.finish" in reached
        assert "probe_pack.blur.unrelated" not in reached
        assert fingerprint(_uses_numpy).reached[-1] == f"numpy {np.__version__}"


class TestKinds:
    """Every kind of object that code may reach: the same cell twice gives one digest, an edited one another."""

    @pytest.mark.parametrize(
        ("cell", "old", "new"),
        [
            ("class M(BaseModel):\n    a: int = 1\ndef f(): return M()", "= 1", "= 2"),
            ("class M(BaseModel):\n    a: int = Field(1, gt=0)\ndef f(): return M()", "gt=0", "gt=1"),
            ("class M(BaseModel):\n    a: int\n    def b(self): return 1\ndef f(): return M()", "return 1", "return 2"),
            ("class E(Enum):\n    A = 1\ndef f(): return E.A", "A = 1", "A = 2"),
            ("E = Enum('E', 'A B')\nX = E.A\ndef f(): return X", "E.A", "E.B"),
            ("def g(a, b): return a\nh = functools.partial(g, 1)\ndef f(): return h", "(g, 1)", "(g, 2)"),
            ("def g(a): return a\nv = np.vectorize(g)\ndef f(): return v", "return a", "return -a"),
            ("def make(n):\n    def g(): return n\n    return g\nf = make(1)", "make(1)", "make(2)"),
            ("P = re.compile('a')\ndef f(): return P", "'a'", "'b'"),
            ("class B:\n    def m(self): return 1\nclass C(B): pass\ndef f(): return C()", "return 1", "return 2"),
            ("class C:\n    @classmethod\n    def m(cls): return 1\ndef f(): return C.m()", "return 1", "return 2"),
            ("class C:\n    def __init__(s): s.k = 1\nc = C()\ndef f(): return c.k", "k = 1", "k = 2"),
            ("T = {'gauss': lambda x: x, 'box': abs}\ndef f(k): return T[k]", "x: x", "x: -x"),
            ("def f(x): return [i * 2 for i in x]", "* 2", "* 3"),
            ("def f(x, *, k=1): return x", "k=1", "k=2"),
            ("def f(x): return x ** 2", "** 2", "** 2.0"),
            ("def f(x):\n    try: return 1\n    except ValueError: return 2", "ValueError", "KeyError"),
            ("D = np.dtype('f4')\ndef f(): return D", "f4", "f8"),
            ("L = threading.Lock()\nK = 1\ndef f(): return L, K", "K = 1", "K = 2"),
            ("K = []\nK.append(K)\nN = 1\ndef f(): return K, N", "N = 1", "N = 2"),
        ],
    )
    def test_kind(self, cell, old, new):
        """Same cell, same digest; edited cell, other digest."""
        assert old in cell
        assert _cell(cell) == _cell(cell)
        assert _cell(cell) != _cell(cell.replace(old, new))


class TestStale:
    def test_fresh(self, load):
        """Nothing replaced: not stale."""
        assert not of(load()).stale()

    @pytest.mark.parametrize(
        ("holder", "name", "value"),
        [
            ("blur", "SCALE", 3),
            ("kernels", "gauss", lambda x, sigma: x),
            ("deep", "normal", lambda x: x),
            ("tables", "Table", dict),
        ],
    )
    def test_replaced_name(self, load, holder, name, value):
        """Replacing what a name means, in whatever module the code reads it, is noticed and changes the digest."""
        module = load()
        before = of(module)
        reader = {"deep": "kernels", "tables": "blur"}.get(holder, holder)
        setattr(sys.modules[f"probe_pack.{reader}"], name, value)
        assert before.stale()
        assert of(module).digest != before.digest

    def test_replaced_code(self, load):
        """A function that is given other code in place is noticed."""
        module = load()
        before = of(module)
        module.kernels.gauss.__code__ = (lambda x, sigma: x).__code__
        assert before.stale()

    def test_replaced_method(self, load):
        """A method patched into a class is noticed."""
        module = load()
        before = of(module)
        module.Table.read = lambda self, lut: 0
        assert before.stale()
        assert of(module).digest != before.digest

    def test_late_import_loaded(self, load):
        """Loading the module of a late import leaves the digest as it was."""
        module = load()
        before = of(module)
        __import__("probe_pack.lazy")
        assert of(module).digest == before.digest

    @pytest.mark.parametrize(("name", "value"), [("finish", lambda y: y), ("AMOUNT", 7), ("step", abs)])
    def test_late_import_patched(self, load, name, value):
        """A name replaced in the module of a late import is noticed, though its source is the same."""
        module = load()
        lazy = __import__("probe_pack.lazy", fromlist=["_"])
        before = of(module)
        setattr(lazy, name, value)
        assert before.stale()
        assert of(module).digest != before.digest

    def test_missing_name_appears(self):
        """A global that did not exist at the first walk is noticed when it is defined."""
        space: dict[str, object] = {"__name__": "cells"}
        exec("def f():\n    return helper()", space)
        before = fingerprint(space["f"])
        exec("def helper():\n    return 1", space)
        assert before.stale()
        assert fingerprint(space["f"]).digest != before.digest


class TestDeterminism:
    def test_across_processes(self, load):
        """Neither the hash seed nor what was imported first changes a digest."""
        folder = load().__file__.rsplit("/", 2)[0]
        program = (
            "import sys; sys.path.insert(0, {folder!r}); {first}\n"
            "from probe_pack import blur; from graphface.cache.fingerprint import fingerprint\n"
            "print(fingerprint(blur.blur, blur.needs).digest.hex())"
        )
        orders = ["", "import probe_pack.lazy", "import probe_pack.last, probe_pack.deep, scipy.ndimage"]
        found = set()
        for seed, first in enumerate(orders):
            run = [sys.executable, "-c", program.format(folder=folder, first=first)]
            found.add(subprocess.check_output(run, env={"PYTHONHASHSEED": str(seed)}, text=True))
        assert len(found) == 1

    def test_repeats(self, load):
        """Walking twice gives the same digest."""
        module = load()
        assert of(module).digest == of(module).digest


class TestReadCode:
    @pytest.mark.parametrize("module", [argparse, json.decoder, random, tokenize], ids=lambda m: m.__name__)
    def test_agrees_with_dis(self, module):
        """Names and constants are those that the standard disassembler finds."""
        spelled = {*dis.hasname, dis.opmap["LOAD_CONST"]}  # dis does not resolve KW_NAMES
        for code in _codes(module):
            ours = [meaning for opcode, _, meaning in instructions(code) if opcode in spelled]
            theirs = [i.argval for i in dis.get_instructions(code) if i.opcode in spelled]
            assert ours == theirs

    @pytest.mark.parametrize("module", [argparse, json.decoder, random], ids=lambda m: m.__name__)
    def test_comments_do_not_count(self, module):
        """A comment line above every logical line of a real module leaves each function's content as it was."""
        with open(module.__file__) as file:
            source = file.read()
        before = compile(source, "a.py", "exec", dont_inherit=True)
        after = compile(_commented(source), "b.py", "exec", dont_inherit=True)
        assert [read_code(c).digest for c in _nested(before)] == [read_code(c).digest for c in _nested(after)]


def _cell(text: str) -> bytes:
    """The digest of `f` as a notebook cell would define it."""
    space: dict[str, object] = {"__name__": "cells"}
    exec("import enum, functools, re, threading\nimport numpy as np\nfrom enum import Enum", space)
    exec("from pydantic import BaseModel, Field\n" + text, space)
    return fingerprint(space["f"]).digest


def _even(n):
    return n == 0 or _odd(n - 1)


def _odd(n):
    return n != 0 and _even(n - 1)


def _uses_numpy(x):
    import numpy as np

    return np.abs(x)


def _codes(module: ModuleType) -> list[CodeType]:
    with open(module.__file__) as file:
        return _nested(compile(file.read(), module.__file__, "exec", dont_inherit=True))


def _nested(code: CodeType) -> list[CodeType]:
    inner = [c for constant in code.co_consts if isinstance(constant, CodeType) for c in _nested(constant)]
    return [code, *inner]


def _commented(source: str) -> str:
    """`source` with a comment line before each logical line."""
    lines = source.splitlines(keepends=True)
    logical, fresh = set(), True
    for token in tokenize.generate_tokens(StringIO(source).readline):
        if token.type in (tokenize.NL, tokenize.COMMENT, tokenize.INDENT, tokenize.DEDENT, tokenize.ENDMARKER):
            continue
        if fresh:
            logical.add(token.start[0])
        fresh = token.type == tokenize.NEWLINE
    return "".join(("# a remark\n\n" if number in logical else "") + line for number, line in enumerate(lines, 1))
