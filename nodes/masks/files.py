"""Reading label weights from a file; the reader is imported when it is needed."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from graphface import Files


def _read_label_weights(path: Path) -> Any:
    from graphface.nodes.masks.label_weights import LabelWeights, read_weights

    return LabelWeights(read_weights(path))


LABEL_WEIGHTS = Files(_read_label_weights)
