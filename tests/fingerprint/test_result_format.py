"""The engine is in no fingerprint: `RESULT_FORMAT` stands for what it does to results.

`GUARDED` lists that code, with a digest of its syntax: how arguments are passed and parameters validated, how given
values are coerced and frozen, how results are stored and read back, what goes into a key. When the code moves, change
the name here and leave the digest; imports do not count.
"""

import ast
from hashlib import blake2b

import pytest

from graphface.fingerprint import RESULT_FORMAT
from graphface.fingerprint.modules import locate
from graphface.fingerprint.syntax import syntax

GUARDED = {
    # arguments and parameters
    "graphface.calling:Caller._call": "0d7135a3c1c7",
    "graphface.calling:Caller.argument": "827db8a19f7c",
    "graphface.calling:take": "e7ac4f2ed25a",
    "graphface.node:Operator.cosmetic": "c4976becc8e0",
    "graphface.node:Operator.needs_none": "d6a03303aebe",
    "graphface.node:Operator.parameters": "f4e494c0c1bd",
    "graphface.wiring:_Wirer._arguments": "3791d2c195b5",
    "graphface.wiring:_Wirer._validate": "953637715abb",
    # given values
    "graphface.inputs:_bind_file": "2a31103e8117",
    "graphface.inputs:_bind_object": "33710ff4445e",
    "graphface.inputs:_from_text": "e0e303043794",
    "graphface.inputs:_read_only": "26cad74f6db0",
    "graphface.values:PortType.coerce": "d82125ab228b",
    "graphface.frozen:freeze": "819f5c1e2c8d",
    # stored values
    "graphface.cache.codec": "0e9654550982",
    # keys
    "graphface.cache.digest": "67d0e3e78b86",
    "graphface.cache.keys": "1ee7121c6309",
}


@pytest.mark.parametrize("name", GUARDED)
def test_guarded(name):
    """Code that can change results has not changed since somebody thought about the number."""
    assert _digest(name) == GUARDED[name], (
        f"{name} has changed: raise the number if results can change (RESULT_FORMAT is {RESULT_FORMAT}), "
        f"then update the digest to {_digest(name)!r}"
    )


def _digest(name: str) -> str:
    """Of the syntax of "module" or "module:Class.method", without the import statements at its top."""
    module, _, inner = name.partition(":")
    path = locate(module)
    assert path is not None, f"no module {module}: give {name} its new name"
    found: ast.AST = ast.parse(path.read_bytes())
    for part in filter(None, inner.split(".")):
        found = next(node for node in found.body if getattr(node, "name", None) == part)
    found.body = [node for node in found.body if not isinstance(node, ast.Import | ast.ImportFrom)]
    return blake2b(syntax(found), digest_size=6).hexdigest()
