"""The syntax of a module as bytes that every Python from 3.11 on writes alike.

`ast.dump` will not do: 3.12 added fields, 3.13 leaves empty ones out. Here whatever is empty is left out, and so is
what cannot change a result: positions, comments, docstrings, what only type checkers read. Nothing but the standard
library is imported, so that a test can run this file on other interpreters.
"""

from __future__ import annotations

import ast
from functools import cache
from typing import Any

_IGNORED_FIELDS = frozenset({"ctx", "kind", "type_comment", "type_ignores"})
_MAYBE_IGNORED = frozenset({ast.Expr, ast.Constant, ast.If})


def syntax(tree: ast.AST) -> bytes:
    """The canonical form of a syntax tree: the kind of each node, its plain fields and how many nodes wait after it.

    Written in ASCII, since which characters `repr` spells out depends on the Unicode tables of the version.
    """
    written: list[Any] = []
    pending = [tree]  # a stack: a sum of a thousand terms is nested a thousand deep
    while pending:
        node = pending.pop()
        written.append(node.__class__.__name__)
        fields = node.__dict__
        for name in _fields(node.__class__):  # type: ignore[arg-type]
            value = fields.get(name)
            if value is None or value == []:
                continue
            written.append(name)
            if isinstance(value, ast.AST):
                pending.append(value)
            elif value.__class__ is list:
                for item in value:
                    if item.__class__ in _MAYBE_IGNORED and ignored(item, node):
                        continue
                    if isinstance(item, ast.AST):
                        pending.append(item)
                    else:
                        written += (len(pending), item)
                written.append(len(pending))
            else:
                written.append(value)
    return ascii(written).encode()


def ignored(item: Any, above: ast.AST) -> bool:
    """Whether an item of the body or the parts of a node says nothing."""
    match item:
        case ast.Expr(value=ast.Constant(value=str())):  # a string that stands alone
            return True
        case ast.Constant(value=""):  # 3.12 puts empty parts into nested format strings
            return isinstance(above, ast.JoinedStr)
    return for_type_checkers(item) and not getattr(item, "orelse", [])


def for_type_checkers(node: ast.AST) -> bool:
    """Whether this is an `if` whose body never runs."""
    test = node.test if isinstance(node, ast.If) else None
    return "TYPE_CHECKING" in (getattr(test, "id", ""), getattr(test, "attr", ""))


@cache
def _fields(kind: type[ast.AST]) -> tuple[str, ...]:
    return tuple(name for name in kind._fields if name not in _IGNORED_FIELDS)
