"""Every operator that is installed can be described: what `graphface nodes`, the schema and `replace` rely on."""

from __future__ import annotations

import pytest

from graphface.registry import default_registry, interchangeable

NAMES = default_registry().names()


@pytest.mark.parametrize("name", NAMES)
class TestEveryOperator:
    def test_is_described(self, name):
        """Its ports, outputs and parameters resolve, and its documentation begins with a sentence."""
        operator = default_registry().operator(name)
        assert operator.parameters.model_json_schema()["type"] == "object"
        assert str(operator.output)
        assert all(str(port.type) for port in operator.inputs.values())
        assert all(str(declared) for declared in operator.outputs.values())
        assert operator.doc.partition("\n")[0].endswith((".", ":")), operator.doc

    def test_alternatives_take_its_place(self, name):
        """What is offered as a swap wants no more than it gets and gives no less than is used."""
        operator = default_registry().operator(name)
        for other in default_registry().alternatives(operator):
            assert interchangeable(operator, other)
            assert other.family == operator.family


class TestFamilies:
    @pytest.mark.parametrize("family", ["detail", "intrinsic", "geometry", "matting", "flow", "scatter"])
    def test_methods_are_interchangeable(self, family):
        """Every method of a family of swaps may stand where any other stands."""
        registry = default_registry()
        methods = [n for n in NAMES if n.rpartition(".")[0] == family]
        assert len(methods) > 2
        for name in methods:
            offered = {other.name for other in registry.alternatives(registry.operator(name))}
            assert offered == set(methods) - {name}
