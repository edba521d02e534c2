"""What runs is what is in memory: names replaced at run time and files edited after they were loaded."""

import functools
import importlib
import sys
from pathlib import Path
from types import ModuleType

import numpy as np
import pytest

from graphface.fingerprint import Fingerprint, fingerprint
from graphface.fingerprint.loaded import Module


def of(module: ModuleType) -> Fingerprint:
    return fingerprint(module.blur, module.needs)


class TestStale:
    def test_fresh(self, load):
        """Nothing replaced: not stale."""
        assert not of(load()).stale()

    @pytest.mark.parametrize(
        ("holder", "name", "value"),
        [
            ("blur", "SCALE", 3),
            ("blur", "WEIGHTS", {"a": 1}),
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
        assert of(module).digest != before.digest

    def test_replaced_default(self, load):
        """A function that is given another default in place is noticed."""
        module = load()
        before = of(module)
        module.kernels.normal.__defaults__ = (1e-3,)
        assert before.stale()
        assert of(module).digest != before.digest

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

    def test_a_builtin_shadowed(self, load):
        """A global that takes the place of a builtin is noticed."""
        module = load()
        before = of(module)
        sys.modules["probe_pack.deep"].max = min
        assert before.stale()
        assert of(module).digest != before.digest

    def test_taken_back(self, load):
        """What was replaced and put back counts as before."""
        module = load()
        before, gauss = of(module), module.kernels.gauss
        module.kernels.gauss = abs
        of(module)
        module.kernels.gauss = gauss
        assert not before.stale()
        assert of(module).digest == before.digest


class TestReplacedBefore:
    """Replaced before the first fingerprint of the process, which so has nothing to compare with but the files."""

    @pytest.mark.parametrize(
        ("holder", "name", "value"),
        [
            ("blur", "SCALE", 3),
            ("kernels", "gauss", lambda x, sigma: x),
            ("kernels", "normal", lambda x: x),
            ("tables", "LUT", [1, 2, 4]),
            ("blur", "resized", abs),
            ("blur", "np", None),
            ("lazy", "AMOUNT", 7),
            ("lazy", "finish", lambda y: y),
        ],
    )
    def test_name(self, load, holder, name, value):
        """Functions, imports and literals are compared with what the file says."""
        before = of(load())
        module = load()
        setattr(__import__(f"probe_pack.{holder}", fromlist=["_"]), name, value)
        assert of(module).digest != before.digest

    def test_wrapped(self, load):
        """A decorator put around a function at run time is noticed, though the function in it is the same."""
        before = of(load())
        module = load()
        gauss = module.kernels.gauss
        module.kernels.gauss = functools.wraps(gauss)(lambda *arguments: 2 * gauss(*arguments))
        assert of(module).digest != before.digest

    def test_a_module(self, load, monkeypatch):
        """A module put in the place of another, for an import inside a function to find."""
        before = of(load())
        module = load()
        digests = {before.digest}
        for scale in (2, 3):
            fake = ModuleType("probe_pack.lazy")
            exec(f"def finish(y): return {scale} * y", vars(fake))
            monkeypatch.setitem(sys.modules, "probe_pack.lazy", fake)
            found = of(module)
            assert not found.stale()
            digests.add(found.digest)
        assert len(digests) == 3
        monkeypatch.delitem(sys.modules, "probe_pack.lazy")
        assert found.stale()
        assert of(module).digest == before.digest

    def test_method_and_attribute(self, load):
        """So are methods and attributes of classes."""
        digests = {of(load()).digest}
        for name, value in (("read", lambda self, lut: 0), ("step", 2)):
            module = load()
            setattr(module.Table, name, value)
            digests.add(of(module).digest)
        assert len(digests) == 3

    def test_two_replacements(self, load, monkeypatch):
        """Two different functions put in the same place give two digests."""
        module = load()
        digests = set()
        for replacement in (lambda x, s: x, lambda x, s: x + 1):
            monkeypatch.setattr(module.kernels, "gauss", replacement)
            digests.add(of(module).digest)
        assert len(digests) == 2


class TestEditedAfterLoading:
    def test_the_file_is_another(self, load):
        """A file edited after the first fingerprint is none of this process's business."""
        module = load()
        before = of(module)
        path = Path(module.kernels.__file__)
        path.write_text(path.read_text().replace("/ sigma", "* sigma"))
        assert not before.stale()
        assert of(module).digest == before.digest

    @pytest.mark.parametrize(
        ("file", "old", "new"),
        [("kernels.py", "/ sigma", "* sigma"), ("blur.py", "SCALE = 2", "SCALE = 5"), ("tables.py", "x * 4", "x * 5")],
    )
    def test_before_the_first_fingerprint(self, load, file, old, new):
        """Its results are neither those of the old file nor, worse, stored as those of the new one."""
        module = load()
        path = Path(module.__file__).with_name(file)
        path.write_text(path.read_text().replace(old, new))
        assert of(module).digest not in (of(load()).digest, of(load({file: (old, new)})).digest)

    def test_a_late_import_not_loaded(self, load):
        """A module that is not loaded yet will be loaded as its file is by then."""
        module = load()
        before = of(module)
        path = Path(module.__file__).with_name("lazy.py")
        path.write_text(path.read_text().replace("AMOUNT = 5", "AMOUNT = 50"))
        assert before.stale()
        assert of(module).digest == of(load({"lazy.py": ("AMOUNT = 5", "AMOUNT = 50")})).digest

    def test_loaded_again(self, load):
        """A module loaded again is as its file is by now; who imported from it before holds what it was."""
        module = load()
        before = of(module)
        path = Path(module.__file__).with_name("tables.py")
        path.write_text(path.read_text().replace("[1, 2, 3]", "[1, 2, 4]"))
        importlib.reload(sys.modules["probe_pack.tables"])
        assert before.stale()
        mixed = of(module)
        importlib.reload(module)
        after = of(module)
        assert len({before.digest, mixed.digest, after.digest}) == 3
        assert after.digest == of(load({"tables.py": ("[1, 2, 3]", "[1, 2, 4]")})).digest


class TestModule:
    def test_used_code_is_the_same(self, load):
        """Python rewrites code as it runs; it still is what the file says."""
        module = load()
        before = of(module)
        for _ in range(1000):
            module.kernels.gauss(1.0, 2.0)
            module.Table(1.0).read(module.LUT)
        load_again = Module("probe_pack.kernels", Module.of("probe_pack.kernels").source, module.kernels, None)
        assert list(load_again.departures()) == []
        assert of(module).digest == before.digest

    def test_caches_fill(self, load):
        """A dictionary that the file makes empty is filled as the program runs: no departure."""
        module = load({"deep.py": ("def normal", "SEEN = {}\n\ndef normal")})
        before = of(module)
        sys.modules["probe_pack.deep"].SEEN["x"] = np.zeros(3)
        assert of(module).digest == before.digest
        assert list(Module.of("probe_pack.deep").departures()) == []
