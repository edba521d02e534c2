"""The small U-Net of `graphface.nodes.unet` in PyTorch, to be trained, and its weights for NumPy."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from itertools import pairwise
from typing import Any

import numpy as np

from graphface import UsageError


def torch_module() -> Any:
    """PyTorch.

    Raises:
        UsageError: it is not installed.
    """
    try:
        import torch
    except ImportError:
        raise UsageError("training a network needs PyTorch: pip install torch, or 'graphface[learn]'") from None
    return torch


def trainable(channels: int, widths: Sequence[int], outputs: int = 3) -> Any:
    """The network with batch normalization in place of biases: cells (N, channels, h, w) to (N, outputs, 2h, 2w)."""
    nn = torch_module().nn

    def convolution(inputs: int, outputs: int) -> Any:
        return nn.Sequential(
            nn.Conv2d(inputs, outputs, 3, padding=1, bias=False), nn.BatchNorm2d(outputs), nn.ReLU(inplace=True)
        )

    class Network(nn.Module):  # type: ignore[misc,name-defined]
        def __init__(self) -> None:
            super().__init__()
            before = [channels, *widths[:-1]]
            self.down = nn.ModuleList(
                nn.Sequential(convolution(i, o), convolution(o, o)) for i, o in zip(before, widths, strict=True)
            )
            self.across = nn.ModuleList(nn.Conv2d(o, i, 1) for i, o in pairwise(widths))
            self.up = nn.ModuleList(convolution(w, w) for w in widths[:-1])
            self.out = nn.Conv2d(widths[0], 4 * outputs, 1)

        def forward(self, cells: Any) -> Any:
            levels = []
            for level, block in enumerate(self.down):
                cells = block(nn.functional.avg_pool2d(cells, 2) if level else cells)
                levels.append(cells)
            for level in reversed(range(len(self.up))):
                wider = nn.functional.interpolate(self.across[level](cells), scale_factor=2, mode="nearest")
                cells = self.up[level](levels[level] + wider)
            return nn.functional.pixel_shuffle(self.out(cells), 2)

    return Network()


def folded(state: Mapping[str, Any]) -> dict[str, np.ndarray]:
    """The weights in the form of `graphface.nodes.unet`: kernels (k, k, in, out), batch normalization folded in."""
    arrays = {name: values.double().numpy() for name, values in state.items() if values.is_floating_point()}
    found: dict[str, np.ndarray] = {}
    for name, kernel in arrays.items():
        if not name.endswith("weight") or kernel.ndim != 4:
            continue
        layer = name.removesuffix(".weight")
        if f"{layer}.bias" in arrays:
            bias = arrays[f"{layer}.bias"]
        else:
            normal = layer.removesuffix(".0") + ".1"
            gain = arrays[f"{normal}.weight"] / np.sqrt(arrays[f"{normal}.running_var"] + 1e-5)
            kernel = kernel * gain[:, None, None, None]
            bias = arrays[f"{normal}.bias"] - gain * arrays[f"{normal}.running_mean"]
            layer = layer.removesuffix(".0")
        found[f"{layer}.weight"] = kernel.transpose(2, 3, 1, 0).astype(np.float16)
        found[f"{layer}.bias"] = bias.astype(np.float32)
    return found
