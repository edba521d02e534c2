"""A small ablation of numbers."""

import pytest
from graph_texts import CHAIN

from graphface import Registry
from graphface.ablation import ablate
from graphface.ablation.running import Ablation


@pytest.fixture
def numbers(registry: Registry) -> Ablation:
    """One case under `toy.add` (5) and `toy.subtract` (1)."""
    return ablate(CHAIN, ["last=add,subtract"], [{"x": 2.0}], loading={"registry": registry})
