"""Weights of the label network on disk: NAME.safetensors, and a card NAME.json that names the training data."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any

from graphface.nodes.masks.label_network import WIDTHS
from graphface.nodes.masks.network_input import CHANNELS
from graphface.nodes.network_weights import Network, read_network, write_network
from graphface.nodes.unet import Weights

NETWORK = Network("graphface-labels-1", "label network", WIDTHS, CHANNELS, "graphface models labels")


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
    return read_network(path, NETWORK)


def write_weights(weights: Mapping[str, Any], card: Mapping[str, Any], path: Path) -> None:
    """Write `path` (.safetensors) and the card beside it.

    Raises:
        UnwritableFile: another suffix, or the folder refuses.
    """
    write_network(weights, card, path, NETWORK)
