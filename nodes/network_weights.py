"""Weights of small networks on disk: NAME.safetensors, and a card NAME.json that names the training data."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from graphface import UnreadableFile, UnwritableFile
from graphface.nodes.unet import Weights
from graphface.values.writing import beside, make_folder


@dataclass(frozen=True)
class Network:
    """A kind of `graphface.nodes.unet`.

    Attributes:
        format: written into the card. name: for messages, as "label network".
        widths: channels at each level. channels: of the input's cells.
        command: what makes such files.
    """

    format: str
    name: str
    widths: tuple[int, ...]
    channels: int
    command: str


def read_network(path: Path, network: Network) -> Weights:
    """Weights as `write_network` writes them, as float32.

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
        reason = f"no such file; the weights of a {network.name} are NAME.safetensors and NAME.json"
        raise UnreadableFile(missing, reason) from None
    except (OSError, ValueError, SafetensorError) as error:
        raise UnreadableFile(path, f"not the weights of a {network.name}: {error}") from error
    if not isinstance(card, dict) or card.get("format") != network.format:
        raise UnreadableFile(card_path, f"its format is not {network.format!r}; `{network.command}` writes such files")
    expected = (1, 1, network.widths[1], network.widths[0])
    if not np.array_equal(tensors.get("across.0.weight", np.zeros(0)).shape, expected):
        raise UnreadableFile(path, f"not the weights of a {network.name} of widths {network.widths}")
    if tensors["down.0.0.weight"].shape[2] != network.channels:
        raise UnreadableFile(path, f"its network does not take {network.channels} input channels")
    return {name: values.astype(np.float32) for name, values in tensors.items()}


def write_network(weights: Mapping[str, Any], card: Mapping[str, Any], path: Path, network: Network) -> None:
    """Write `path` (.safetensors), kernels as float16 and biases as float32, and the card beside it.

    Raises:
        UnwritableFile: another suffix, or the folder refuses.
    """
    from safetensors.numpy import save_file

    if path.suffix != ".safetensors":
        raise UnwritableFile(path, f"the weights of a {network.name} are written as NAME.safetensors (and NAME.json)")
    tensors = {
        name: np.ascontiguousarray(values, np.float16 if name.endswith("weight") else np.float32)
        for name, values in sorted(weights.items())
    }
    told = json.dumps({"format": network.format, **card}, indent=2) + "\n"
    make_folder(path.parent)
    try:
        with beside(path) as weights_file, beside(path.with_suffix(".json")) as card_file:
            save_file(tensors, weights_file)
            card_file.write_text(told, encoding="utf-8")
    except OSError as error:
        raise UnwritableFile(path, error.strerror or str(error)) from error
