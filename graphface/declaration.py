"""The signature of an operator read and checked: everything wrong with it is told at once, with what to write instead.

Read when an operator is first used, not when its module is imported: one operator that is declared wrongly must not
keep the others of its module from working.
"""

from __future__ import annotations

import inspect
import typing
from collections.abc import Callable, Iterator
from typing import TYPE_CHECKING, Any

from graphface.code_line import declaration_line
from graphface.errors import DeclarationError, WrongArgument
from graphface.values.port_types import is_lazy, port_type

if TYPE_CHECKING:
    from pydantic import BaseModel

Signature = tuple[inspect.Signature, dict[str, Any]]
"""Of a function: its arguments, and the annotation of each and of "return", resolved."""

_RESOLVE = "import what it names at the top of the module, outside of TYPE_CHECKING"

_PARAMETER = "write a number, a text, a Literal or a pydantic model, or make it a port"


def read_signature(name: str, function: Callable[..., Any], rule: Callable[..., Any] | None) -> Signature:
    """The signature of an operator.

    Args:
        name: of the operator. rule: its `needs` rule, if it has one.

    Raises:
        DeclarationError: it cannot be an operator's; all problems with file and line.
    """
    try:
        signature = inspect.signature(function)
        hints = typing.get_type_hints(function, include_extras=True)
    except Exception as error:
        wrong = [WrongArgument(*_unresolved(function, error))]
    else:
        wrong = list(_problems(signature, hints, rule))
    if wrong:
        raise DeclarationError(name, *_declared_at(function), wrong)
    return signature, hints


def parameter_model(name: str, function: Callable[..., Any], fields: dict[str, Any]) -> type[BaseModel]:
    """The pydantic model of an operator's parameters.

    Args:
        fields: parameter to its annotation and default (... where it has none).

    Raises:
        DeclarationError: pydantic cannot check a parameter of such a type.
    """
    from pydantic import ConfigDict, create_model

    config = ConfigDict(extra="forbid", validate_default=True, allow_inf_nan=False)
    try:
        return create_model(f"{name} parameters", __config__=config, **fields)
    except Exception as error:
        if len(fields) == 1:
            reason = f"pydantic cannot check it ({str(error).partition('. ')[0]}); {_PARAMETER}"
            wrong = [WrongArgument(field, reason) for field in fields]
            raise DeclarationError(name, *_declared_at(function), wrong) from error
        for field, declared in fields.items():
            parameter_model(name, function, {field: declared})
        raise


def _declared_at(function: Callable[..., Any]) -> tuple[str, int]:
    """File and line."""
    line = declaration_line(function)
    return (line.file, line.line) if line is not None else (function.__module__, 0)


def _unresolved(function: Callable[..., Any], error: Exception) -> tuple[str, str]:
    """The argument whose annotation, written as a text, cannot be resolved, and what to do about it."""
    reason = f"{type(error).__name__}: {error}"
    for argument, written in getattr(function, "__annotations__", {}).items():
        try:
            if isinstance(written, str):
                eval(written, getattr(function, "__globals__", {}))
        except Exception:
            return argument, f"its annotation {written!r} cannot be resolved ({reason}); {_RESOLVE}"
    return "", f"an annotation cannot be resolved ({reason}); {_RESOLVE}"


def _problems(signature: inspect.Signature, hints: dict[str, Any], rule: object) -> Iterator[WrongArgument]:
    for argument in signature.parameters.values():
        name, port = argument.name, argument.kind is not argument.KEYWORD_ONLY
        if argument.kind is argument.VAR_POSITIONAL:
            yield WrongArgument(name, f"*{name} gives ports no names; for many values on one port write 'x: list[X]'")
        elif argument.kind is argument.VAR_KEYWORD:
            yield WrongArgument(name, f"**{name} gives parameters no names; write each of them behind a '*'")
        elif argument.kind is argument.POSITIONAL_ONLY:
            yield WrongArgument(name, "ports are passed by name; take away the '/' of the signature")
        elif name not in hints:
            example = f"'{name}: Image'" if port else f"'{name}: float'"
            yield WrongArgument(name, f"it has no annotation; write its type, as in {example}")
        elif port:
            yield from _port_problems(name, hints[name], rule)
    if "return" not in hints:
        yield WrongArgument("return", "it has no annotation; write its type, as in '-> Image'")
    else:
        yield from _port_problems("return", hints["return"], rule)


def _port_problems(name: str, annotation: Any, rule: object) -> Iterator[WrongArgument]:
    try:
        port_type(annotation)
    except Exception as error:
        yield WrongArgument(name, f"{error}; write a class, an array type, a list of one, or alternatives of them")
    if is_lazy(annotation) and rule is None:
        yield WrongArgument(name, "the port is Lazy and no rule says when it is wanted; write @node(..., needs=rule)")
