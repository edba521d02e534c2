"""What a test of an operator wants to know, in three lines:

    from graphface.testing import check_node

    def test_blur():
        check_node(blur, image, sigma=2.0)

Everything memoization and threads rely on is checked: the operator does what its annotations say, changes none of its
inputs, gives the same answer twice, gives finite values for finite inputs, and does not break down over NaN: it refuses
it clearly, absorbs it, or passes it on for the engine's guard to see.
"""

from __future__ import annotations

import copy
from collections.abc import Callable
from itertools import count
from typing import Any

import numpy as np

from graphface.errors import GraphfaceError
from graphface.node import Operator, operator_of
from graphface.values.digest import digest_value
from graphface.values.frozen import arrays_in, first_non_finite, freeze, with_arrays


def check_node(function: Callable[..., Any], *inputs: Any, absorbs_nan: bool = False, **parameters: Any) -> Any:
    """Check one operator on one set of inputs; its output, for further assertions.

    Args:
        function: declared with `@node`.
        inputs: values of its ports, in order. parameters: by name, validated as in a graph.
        absorbs_nan: demand that NaN and infinity in an input never reach the output.

    Raises:
        AssertionError: says which promise was broken, and by which port or field.
    """
    operator = operator_of(function)
    assert operator is not None, f"{function!r} is not declared with @node"
    checked = operator.parameters.model_validate(parameters)
    values = {name: getattr(checked, name) for name in operator.parameters.model_fields}
    check_ports(operator, inputs)
    check_rule(operator, inputs, values)
    output = check_pure(operator, inputs, values)
    problem = operator.output.problem(output)
    assert problem is None, f"{operator.name}: output {problem}"
    found = first_non_finite(output, {})
    assert found is None, f"{operator.name}: output {found}"
    check_non_finite(operator, inputs, values, absorbs=absorbs_nan)
    return output


def check_ports(operator: Operator, inputs: tuple[Any, ...]) -> None:
    """Each input is of the type its port declares."""
    ports = list(operator.inputs.values())
    required = [p for p in ports if p.required]
    assert len(required) <= len(inputs) <= len(ports), (
        f"{operator.name}: takes {len(required)} to {len(ports)} inputs, got {len(inputs)}"
    )
    for port, value in zip(ports, inputs, strict=False):
        problem = port.type.problem(value)
        assert problem is None or (port.lazy and value is None), f"{operator.name}.{port.name}: {problem}"


def check_rule(operator: Operator, inputs: tuple[Any, ...], parameters: dict[str, Any]) -> None:
    """The `needs` rule, where there is one, asks for nothing lazy and answers for lazy ports only."""
    lazy = {port.name for port in operator.inputs.values() if port.lazy}
    known = {*operator.inputs, *operator.parameters.model_fields} - lazy
    unknown = set(operator.rule_arguments) - known
    assert not unknown, f"{operator.name}: its rule asks for {', '.join(sorted(unknown))}, which it cannot see"
    if operator.needs is None:
        return
    given = dict(zip(operator.inputs, inputs, strict=False)) | parameters
    answers = operator.needs(**{name: given.get(name) for name in operator.rule_arguments})
    strangers = set(answers) - lazy
    assert not strangers, f"{operator.name}: its rule answers for {', '.join(sorted(strangers))}, no lazy port of it"


def check_pure(operator: Operator, inputs: tuple[Any, ...], parameters: dict[str, Any]) -> Any:
    """Two calls on read-only inputs give the same bytes and leave the inputs as they were; the output."""
    frozen = copy.deepcopy(inputs)
    freeze(list(frozen))
    before = digest_value(frozen)
    try:
        first = operator.function(*frozen, **parameters)
        freeze(first)  # as the engine does: a buffer that the operator keeps and fills again shows up here
        after_one = digest_value(first)
        second = operator.function(*frozen, **parameters)
    except ValueError as error:
        if "read-only" in str(error):
            raise AssertionError(f"{operator.name}: writes to an input, or to an output it gave before") from error
        raise
    assert digest_value(frozen) == before, f"{operator.name}: changed one of its inputs"
    assert after_one == digest_value(second), f"{operator.name}: two calls gave different results"
    assert after_one == digest_value(first), f"{operator.name}: the second call changed the output of the first"
    return first


def check_non_finite(
    operator: Operator, inputs: tuple[Any, ...], parameters: dict[str, Any], *, absorbs: bool = False
) -> None:
    """With a NaN or an infinity in any one array, the call is refused with a clear error (ValueError or one of
    graphface's), or the output is of its declared type, and with `absorbs` finite."""
    for index, (port, value) in enumerate(zip(operator.inputs, inputs, strict=False)):
        for which, (path, array) in enumerate(arrays_in(value)):
            if array.dtype.kind not in "fc" or array.size == 0:
                continue
            where = f"{port}.{path}" if path else port
            for bad in (np.nan, np.inf):
                spoilt = [*inputs[:index], _spoilt(value, which, bad), *inputs[index + 1 :]]
                try:
                    with np.errstate(all="ignore"):
                        output = operator.function(*spoilt, **parameters)
                except (GraphfaceError, ValueError):
                    continue
                except Exception as error:
                    raise AssertionError(
                        f"{operator.name}: {bad} in {where}: {type(error).__name__}: {error}; say clearly what is wrong"
                    ) from error
                found = operator.output.problem(output) or (first_non_finite(output, {}) if absorbs else None)
                assert found is None, f"{operator.name}: {bad} in {where}: output {found}"


def _spoilt(value: Any, which: int, bad: float) -> Any:
    """The same value with one entry in the middle of its array number `which` replaced."""
    numbers = count()

    def spoilt(array: np.ndarray) -> np.ndarray:
        if next(numbers) != which:
            return array
        copied = array.copy()
        copied.flat[array.size // 2] = bad
        return copied

    return with_arrays(value, spoilt)
