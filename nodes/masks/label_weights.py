"""Weights of the label network on disk: NAME.safetensors, and a card NAME.json that names the training data."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np

from graphface import UnreadableFile, UnwritableFile
from graphface.nodes.masks.label_network import WIDTHS, Weights
from graphface.nodes.masks.network_input import CHANNELS

FORMAT = "graphface-labels-1"


SHIPPED = Path(__file__).with_name("labels.safetensors")
"""A constant of the module, so that its content is part of the fingerprint of the code that uses it."""


@dataclass(frozen=True)
class LabelWeights:
    """Weights of a label network by layer; as a graph input, a file that `graphface models labels` wrote."""

    arrays: Weights


@cache
def shipped_weights() -> Weights:
    """The weights that come with the package."""
    return read_weights(SHIPPED)


def read_weights(path: Path) -> Weights:
    """Weights as `write_weights` writes them, as float32.

    Raises:
        UnreadableFile: the file or its card is missing, damaged, or of another network.
    """
    from safetensors import SafetensorError
    from safetensors.numpy import load_file

    card_path = path.with_suffix(".json")
    try:
        tensors = load_file(path)
        card = json.loads(card_path.read_text(encoding="utf-8"))
    except FileNotFoundError as error:
        missing = error.filename or path
        raise UnreadableFile(missing, "no such file; label weights are NAME.safetensors and NAME.json") from None
    except (OSError, ValueError, SafetensorError) as error:
        raise UnreadableFile(path, f"not the weights of a label network: {error}") from error
    if not isinstance(card, dict) or card.get("format") != FORMAT:
        raise UnreadableFile(card_path, f"its format is not {FORMAT!r}; `graphface models labels` writes such files")
    if not np.array_equal(tensors.get("across.0.weight", np.zeros(0)).shape, (1, 1, WIDTHS[1], WIDTHS[0])):
        raise UnreadableFile(path, f"not the weights of a label network of widths {WIDTHS}")
    if tensors["down.0.0.weight"].shape[2] != CHANNELS:
        raise UnreadableFile(path, f"its network does not take {CHANNELS} input channels")
    return {name: values.astype(np.float32) for name, values in tensors.items()}


def write_weights(weights: Mapping[str, Any], card: Mapping[str, Any], path: Path) -> None:
    """Write `path` (.safetensors), kernels as float16 and biases as float32, and the card beside it.

    Raises:
        UnwritableFile: another suffix, or the folder refuses.
    """
    from safetensors.numpy import save_file

    if path.suffix != ".safetensors":
        raise UnwritableFile(path, "label weights are written as NAME.safetensors (and NAME.json)")
    tensors = {
        name: np.ascontiguousarray(values, np.float16 if name.endswith("weight") else np.float32)
        for name, values in sorted(weights.items())
    }
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        save_file(tensors, path)
        path.with_suffix(".json").write_text(json.dumps({"format": FORMAT, **card}, indent=2) + "\n", encoding="utf-8")
    except OSError as error:
        raise UnwritableFile(path, error.strerror or str(error)) from error
