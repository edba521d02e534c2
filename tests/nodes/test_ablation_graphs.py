"""The shipped ablation graphs: every variant is wired, and changes what it says."""

from __future__ import annotations

from pathlib import Path

import pytest

from graphface import load
from graphface.registry import default_registry

FOLDER = next(f for f in default_registry().graph_folders() if (f / "ablations").is_dir()) / "ablations"
VARIANTS = [(path, name) for path in sorted(FOLDER.glob("*.yaml")) for name in load(path).composition.variants]


def operators(graph):
    return {step.name: (step.operator.name, str(sorted(step.parameters.items()))) for step in graph.steps}


@pytest.mark.parametrize(("path", "name"), VARIANTS, ids=lambda v: v.stem if isinstance(v, Path) else v)
def test_variant(path, name):
    """It loads, and differs from the graph as it is unless it stands for that; makeup's ablations are the paper's."""
    changed = operators(load(path, variants=[name])) != operators(load(path))
    assert changed == ((path.stem, name) != ("makeup-transfer", "paper") and name != "as-shipped")
