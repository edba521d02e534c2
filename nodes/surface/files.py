"""Reading weights of the normals network from a file; the reader is imported when it is needed."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from graphface import Files


def _read_normal_weights(path: Path) -> Any:
    from graphface.nodes.network_weights import read_network
    from graphface.nodes.surface.normal_network import NETWORK, NormalWeights

    return NormalWeights(read_network(path, NETWORK))


NORMAL_WEIGHTS = Files(_read_normal_weights)
