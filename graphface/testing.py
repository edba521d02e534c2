"""What a test of an operator wants to know, in three lines:

    from graphface.testing import check_node

    def test_blur():
        check_node(blur, image, sigma=2.0)

Everything memoization and threads rely on is checked: the operator does what its annotations say, changes none of its
inputs, gives the same answer twice, and either answers non-finite input with finite values or refuses it clearly.
"""

from __future__ import annotations

import copy
from collections.abc import Callable
from dataclasses import is_dataclass, replace
from typing import Any

import numpy as np

from graphface.cache.digest import digest_value
from graphface.errors import GraphfaceError
from graphface.frozen import arrays_in, field_names, first_non_finite, freeze
from graphface.node import Operator, operator_of


def check_node(function: Callable[..., Any], *inputs: Any, non_finite: bool = True, **parameters: Any) -> Any:
    """Check one operator on one set of inputs; its output, for further assertions.

    Args:
        function: declared with `@node`.
        inputs: values of its ports, in order. parameters: by name, validated as in a graph.
        non_finite: also feed it NaN and infinity.

    Raises:
        AssertionError: says which promise was broken, and by which port or field.
    """
    operator = operator_of(function)
    assert operator is not None, f"{function!r} is not declared with @node"
    checked = operator.parameters.model_validate(parameters)
    values = {name: getattr(checked, name) for name in operator.parameters.model_fields}
    check_ports(operator, inputs)
    output = check_pure(operator, inputs, values)
    problem = operator.output.problem(output)
    assert problem is None, f"{operator.name}: output {problem}"
    found = first_non_finite(output, {})
    assert found is None, f"{operator.name}: output {found}"
    if non_finite:
        check_non_finite(operator, inputs, values)
    return output


def check_ports(operator: Operator, inputs: tuple[Any, ...]) -> None:
    """Each input is of the type its port declares."""
    required = [p for p in operator.inputs.values() if p.required]
    assert len(inputs) >= len(required), (
        f"{operator.name}: {len(required)} ports are required, got {len(inputs)} inputs"
    )
    for port, value in zip(operator.inputs.values(), inputs, strict=False):
        problem = port.type.problem(value)
        assert problem is None or (port.lazy and value is None), f"{operator.name}.{port.name}: {problem}"


def check_pure(operator: Operator, inputs: tuple[Any, ...], parameters: dict[str, Any]) -> Any:
    """Two calls on read-only inputs give the same bytes and leave the inputs as they were; the output."""
    frozen = copy.deepcopy(inputs)
    freeze(list(frozen))
    before = digest_value(frozen)
    first = operator.function(*frozen, **parameters)
    assert digest_value(frozen) == before, f"{operator.name}: changed one of its inputs"
    second = operator.function(*frozen, **parameters)
    assert digest_value(first) == digest_value(second), f"{operator.name}: two calls gave different results"
    return first


def check_non_finite(operator: Operator, inputs: tuple[Any, ...], parameters: dict[str, Any]) -> None:
    """With a NaN or an infinity in any one array, the output is finite or the call is refused with a clear error."""
    for index, value in enumerate(inputs):
        for path, array in arrays_in(value):
            if array.dtype.kind != "f" or array.size == 0:
                continue
            for bad in (np.nan, np.inf):
                spoilt = [*inputs[:index], _spoil(value, path, bad), *inputs[index + 1 :]]
                try:
                    output = operator.function(*spoilt, **parameters)
                except (GraphfaceError, ValueError):
                    continue
                found = first_non_finite(output, {})
                port = list(operator.inputs)[index]
                assert found is None, f"{operator.name}: {bad} in {port}{'.' if path else ''}{path}: output {found}"


def _spoil(value: Any, path: str, bad: float) -> Any:
    """A copy of a value with one entry of the array at `path` replaced."""
    if isinstance(value, np.ndarray):
        spoilt = value.copy()
        spoilt.flat[spoilt.size // 2] = bad
        return spoilt
    if is_dataclass(value) and not isinstance(value, type):
        head, _, rest = path.partition(".")
        if head in field_names(type(value)):
            return replace(value, **{head: _spoil(getattr(value, head), rest, bad)})
    return value
