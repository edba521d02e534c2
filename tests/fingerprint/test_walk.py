"""Code that stands in no file is described as it is: the same cell twice gives one digest, an edited one another."""

import functools

import numpy as np
import pytest

from graphface.fingerprint import fingerprint


class TestKinds:
    """Every kind of object that code may reach."""

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
            ("def f(x, *, k: int = 1): return x", "k: int", "k: float"),
            ("def f(x): return x ** 2", "** 2", "** 2.0"),
            ("def f(x):\n    try: return 1\n    except ValueError: return 2", "ValueError", "KeyError"),
            ("def f(x): return x in {'a', 'b'}", "'b'", "'c'"),
            ("def f():\n    class C:\n        a = 1\n    return C", "a = 1", "a = 2"),
            ("D = np.dtype('f4')\ndef f(): return D", "f4", "f8"),
            ("L = threading.Lock()\nK = 1\ndef f(): return L, K", "K = 1", "K = 2"),
            ("K = []\nK.append(K)\nN = 1\ndef f(): return K, N", "N = 1", "N = 2"),
            ("K = {1, 2}\ndef f(): return K", "1, 2", "1, 3"),
            ("class D:\n    a = property(lambda s: 1)\ndef f(): return D().a", "s: 1", "s: 2"),
            ("@lru_cache\ndef g(): return 1\ndef f(): return g()", "return 1", "return 2"),
            ("@dataclass\nclass D:\n    a: int = 1\ndef f(): return D()", "= 1", "= 2"),
            (
                "@dataclass\nclass D:\n    a: list = field(default_factory=lambda: [1])\ndef f(): return D()",
                "[1]",
                "[2]",
            ),
        ],
    )
    def test_kind(self, cell, old, new):
        """Same cell, same digest; edited cell, other digest."""
        assert old in cell
        assert _cell(cell) == _cell(cell)
        assert _cell(cell) != _cell(cell.replace(old, new))


class TestFunctions:
    def test_imports_of_a_cell(self, load):
        """What a cell imports inside a function counts as for any other."""
        cell = (
            "def f(x):\n    from probe_pack.lazy import finish\n    from probe_pack import last\n    return finish(x)"
        )
        load()
        before = _cell(cell)
        load({"lazy.py": ("AMOUNT = 5", "AMOUNT = 6")})
        assert _cell(cell) != before
        load({"last.py": ("y + 1", "y + 2")})
        assert _cell(cell) != before
        load()
        assert _cell(cell) == before

    def test_modules_a_cell_names(self, load):
        """A module that a cell uses counts in whole."""
        cell = "from probe_pack import kernels\ndef f(x):\n    return kernels.gauss(x, 1)"
        load()
        before = _cell(cell)
        load({"deep.py": ("1e-6", "1e-5")})
        assert _cell(cell) != before

    def test_closures_of_a_file(self):
        """Functions made in a function of a file differ in their code and in what they close over."""

        def make(n):
            return [lambda: n, lambda: n]

        one, other = make(1)
        assert fingerprint(one).digest == fingerprint(make(1)[0]).digest
        assert len({fingerprint(f).digest for f in (one, other, *make(2))}) == 4

    def test_a_partial(self):
        """A partial counts with its function and what it holds."""
        digests = {fingerprint(functools.partial(_scaled, by=by)).digest for by in (1, 2, np.ones(2))}
        assert len(digests) == 3

    def test_somebody_elses_decorator(self):
        """What a released package's decorator wraps counts."""
        cell = "@np.vectorize\ndef g(a): return a\ndef f(x): return g(x)"
        assert _cell(cell) != _cell(cell.replace("return a", "return -a"))


def _cell(text: str) -> bytes:
    """The digest of `f` as a notebook cell would define it."""
    space: dict[str, object] = {"__name__": "cells"}
    exec("import enum, functools, re, threading\nimport numpy as np\nfrom enum import Enum", space)
    exec("from dataclasses import dataclass, field\nfrom functools import lru_cache", space)
    exec("from pydantic import BaseModel, Field\n" + text, space)
    return fingerprint(space["f"]).digest


def _scaled(x, by):
    return x * by
