"""A small package of operators, written to disk, edited and imported again."""

import itertools
import sys
from collections.abc import Callable, Iterator
from types import ModuleType

import pytest

PACKAGE = {
    "__init__.py": "",
    "blur.py": '''
"""Blurring."""
import functools
from dataclasses import dataclass
from typing import TYPE_CHECKING
import numpy as np
from probe_pack import kernels
from probe_pack.tables import LUT, Table
from probe_pack.tables import scaled as resized

if TYPE_CHECKING:
    from probe_pack.apart import other

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
    "apart.py": "def other(y):\n    return y\n",
}

Edits = dict[str, tuple[str, str]]
Load = Callable[..., ModuleType]


@pytest.fixture
def load(tmp_path, monkeypatch) -> Iterator[Load]:
    """Writes the package with edits {file: (old, new)} into a folder of its own, and imports its `blur` module.

    Each loading is like a new process: the modules of the last one are forgotten.
    """
    monkeypatch.setattr(sys, "dont_write_bytecode", True)
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
            (folder / "probe_pack" / name).write_text(text.replace(old, new, 1) if old else new + text)
        monkeypatch.syspath_prepend(folder)
        return __import__(f"probe_pack.{operator}", fromlist=["_"])

    yield load
    unload()
