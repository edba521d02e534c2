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
    "graphface.evaluate.calling:Caller._call": "58d9da3dc862",
    "graphface.evaluate.calling:Caller.argument": "d2643b67e89d",
    "graphface.graph.demand:take": "e7ac4f2ed25a",
    "graphface.node:Operator.cosmetic": "c4976becc8e0",
    "graphface.node:Operator.needs_none": "d6a03303aebe",
    "graphface.node:Operator.parameters": "73840f6c1730",
    "graphface.graph.wiring:_Wirer._arguments": "3791d2c195b5",
    "graphface.graph.wiring:_Wirer._validate": "46a411889fc1",
    # given values
    "graphface.graph.inputs:_bind_file": "eca4908ee9de",
    "graphface.graph.inputs:_bind_object": "7f6a54c85c7d",
    "graphface.graph.inputs:_from_text": "e0e303043794",
    "graphface.graph.inputs:_own": "7c42d5152225",
    "graphface.values.port_types:PortType.coerce": "d82125ab228b",
    "graphface.values.frozen:freeze": "7e0cdc14f75f",
    # stored values
    "graphface.values.parts": "c3554acb3858",
    "graphface.values.codec": "f27e20f3b041",
    # keys
    "graphface.values.digest": "f657f3225d49",
    "graphface.graph.keys": "c208235c744c",
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
