"""A fingerprint changes with everything a result depends on in the code, and with little else.

Each case writes a small package, fingerprints its operator, writes an edited copy and compares.
"""

import subprocess
import sys
from types import ModuleType

import numpy as np
import pytest

from graphface.fingerprint import Fingerprint, fingerprint
from graphface.fingerprint.modules import locate
from graphface.registry import default_registry


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
            pytest.param("blur.py", "return 1", "return 2", id="another function of the module"),
            pytest.param("__init__.py", "", "import os\nos.nice(0)\n", id="package around that does something"),
        ],
    )
    def test_an_edit_that_matters(self, load, file, old, new):
        """Every statement counts of the operator's module and of those of its distribution that this imports."""
        assert of(load()).digest != of(load({file: (old, new)})).digest

    @pytest.mark.parametrize(
        ("file", "old", "new"),
        [
            pytest.param("blur.py", '"""Blur."""', '"""Blur, in other words.\n\n    And more."""', id="docstring"),
            pytest.param("blur.py", '    """Blur."""\n', "", id="no docstring"),
            pytest.param("blur.py", "SCALE = 2", 'SCALE = 2\n"""Twice."""', id="docstring of a constant"),
            pytest.param("blur.py", "    y = kernels", "    # why\n\n    y = kernels", id="comment"),
            pytest.param("blur.py", "SCALE = 2", "\n\n\n# twice\nSCALE = 2", id="line numbers"),
            pytest.param("blur.py", "(x, sigma) *", "(\n        x,\n        (sigma),\n    ) *", id="layout"),
            pytest.param("deep.py", '"a", "b"', "'a', 'b'", id="quotes"),
            pytest.param("deep.py", "# keep away from zero", "# floor", id="comment in a helper"),
            pytest.param("lazy.py", "AMOUNT = 5", "# five\n\nAMOUNT = 5", id="comment in a late import"),
            pytest.param("apart.py", "return y", "return -y", id="module imported for type checkers only"),
            pytest.param("__init__.py", "", "from probe_pack.apart import other\nTABLE = {}\n", id="package around"),
        ],
    )
    def test_an_edit_that_does_not(self, load, file, old, new):
        """Comments, docstrings, layout and modules that are not imported do not count."""
        assert of(load()).digest == of(load({file: (old, new)})).digest

    def test_a_package_something_is_imported_from(self, load):
        """The package around counts in whole where the operator takes a name from it."""
        takes = ("blur.py", ("SCALE = 2", "from probe_pack import SCALE"))
        before, after = (of(load(dict([takes, ("__init__.py", ("", f"SCALE = {n}\n"))]))) for n in (2, 3))
        assert before.digest != after.digest

    @pytest.mark.parametrize("new", ["import probe_pack.apart", "from . import apart", "from .apart import other as o"])
    def test_every_form_of_import(self, load, new):
        """Plain, relative, of a module or of a name in it."""
        edits = {"lazy.py": ("import math", new)}
        after = of(load(edits | {"apart.py": ("return y", "return -y")}))
        assert "probe_pack.apart" in after.reached
        assert of(load(edits)).digest != after.digest

    def test_recursion_ends(self):
        """Functions that call each other have a fingerprint."""
        assert len(fingerprint(_even).digest) == 16

    def test_lists_what_was_reached(self, load):
        """`reached` names modules, and released packages with their versions."""
        reached = of(load()).reached
        assert {f"probe_pack.{name}" for name in ("blur", "kernels", "deep", "tables", "lazy", "last")} <= set(reached)
        assert f"numpy {np.__version__}" in reached
        assert not {"probe_pack", "probe_pack.apart", "functools", "math"} & set(reached)


class TestShipped:
    def test_the_engine_stays_out(self):
        """Operators import the engine, and an edit of it leaves their results alone."""
        registry = default_registry()
        for name in ("masks.geometric", "render.shade", "geometry.morphable"):
            operator = registry.operator(name)
            mine = [n for n in fingerprint(operator.function, operator.needs).reached if n.startswith("graphface")]
            assert operator.function.__module__ in mine
            assert all(n.startswith("graphface.nodes.") for n in mine)

    def test_nothing_departs_from_its_file(self):
        """In a process that replaced nothing, every shipped operator counts by its files: no function, no class."""
        registry = default_registry()
        for operator in map(registry.operator, registry.names()):
            for name in fingerprint(operator.function, operator.needs).reached:
                assert " " in name or locate(name) is not None


class TestDeterminism:
    def test_across_processes(self, load):
        """Neither the hash seed nor what was imported first changes a digest."""
        folder = load().__file__.rsplit("/", 2)[0]
        program = (
            "import sys; sys.path.insert(0, {folder!r}); {first}\n"
            "from probe_pack import blur; from graphface.fingerprint import fingerprint\n"
            "print(fingerprint(blur.blur, blur.needs).digest.hex())"
        )
        orders = ["", "import probe_pack.lazy", "import probe_pack.last, probe_pack.deep, scipy.ndimage"]
        found = set()
        for seed, first in enumerate(orders):
            run = [sys.executable, "-c", program.format(folder=folder, first=first)]
            found.add(subprocess.check_output(run, env={"PYTHONHASHSEED": str(seed)}, text=True))
        assert len(found) == 1

    def test_compiled_before(self, load):
        """Whether Python finds the modules compiled changes nothing."""
        folder = load().__file__.rsplit("/", 2)[0]
        program = (
            f"import sys; sys.path.insert(0, {folder!r})\n"
            "from probe_pack import blur; from graphface.fingerprint import fingerprint\n"
            "print(fingerprint(blur.blur, blur.needs).digest.hex())"
        )
        run = [sys.executable, "-c", program]
        found = {subprocess.check_output(run, env={"PYTHONDONTWRITEBYTECODE": off}, text=True) for off in ("1", "", "")}
        assert len(found) == 1

    def test_repeats(self, load):
        """Walking twice gives the same digest."""
        module = load()
        assert of(module).digest == of(module).digest


def _even(n):
    return n == 0 or _odd(n - 1)


def _odd(n):
    return n != 0 and _even(n - 1)
