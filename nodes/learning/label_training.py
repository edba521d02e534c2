"""Training of the label network with PyTorch, which only this module needs."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from itertools import pairwise
from typing import Any

import numpy as np
from numpy.typing import NDArray

from graphface import UsageError
from graphface.nodes.masks.label_network import WIDTHS
from graphface.nodes.masks.network_input import CHANNELS

BATCH, RATE, DECAY = 8, 4e-3, 1e-2
"""Pictures in a step; largest learning rate and weight decay of AdamW."""


@dataclass(frozen=True)
class Examples:
    """Variations of training pictures, float16: `cells` (N, C, h, w), `labels` (N, 3, 2h, 2w) and `weight`
    (N, 2h, 2w)."""

    cells: NDArray[np.float16]
    labels: NDArray[np.float16]
    weight: NDArray[np.float16]


def trained(examples: Examples, *, steps: int, seed: int = 0) -> dict[str, Any]:
    """The state of a network trained on the examples, in a new random order in each epoch.

    Raises:
        UsageError: PyTorch is not installed.
    """
    torch = _torch()
    torch.manual_seed(seed)
    random = np.random.default_rng(seed)
    net = network().to(memory_format=torch.channels_last).train()
    optimizer = torch.optim.AdamW(net.parameters(), lr=RATE, weight_decay=DECAY)
    schedule = torch.optim.lr_scheduler.OneCycleLR(optimizer, RATE, total_steps=steps, pct_start=0.15)
    order: list[int] = []
    running = 0.0
    for step in range(steps):
        if len(order) < BATCH:
            order = random.permutation(len(examples.cells)).tolist()
        chosen, order = sorted(order[:BATCH]), order[BATCH:]
        cells, labels, weight = (
            torch.from_numpy(part[chosen]).float() for part in (examples.cells, examples.labels, examples.weight)
        )
        logits = net(cells.to(memory_format=torch.channels_last))
        losses = weight * -(labels * torch.log_softmax(logits, dim=1)).sum(dim=1)
        loss = (losses.sum(dim=(1, 2)) / weight.sum(dim=(1, 2)).clamp(min=1)).mean()  # per frame, then over pictures
        optimizer.zero_grad()
        loss.backward()
        torch.nn.utils.clip_grad_norm_(net.parameters(), 1.0)
        optimizer.step()
        schedule.step()
        running += (float(loss.detach()) - running) * max(0.01, 1 / (step + 1))
        if step % 200 == 199:
            print(f"  {step + 1} of {steps} steps, loss {running:.4f}", flush=True)
    return {name: values.clone() for name, values in net.state_dict().items()}


def network() -> Any:
    """The network of `masks.label_network`, with batch normalization in place of biases."""
    nn = _torch().nn

    def convolution(inputs: int, outputs: int) -> Any:
        return nn.Sequential(
            nn.Conv2d(inputs, outputs, 3, padding=1, bias=False), nn.BatchNorm2d(outputs), nn.ReLU(inplace=True)
        )

    class Network(nn.Module):  # type: ignore[misc,name-defined]
        def __init__(self) -> None:
            super().__init__()
            before = [CHANNELS, *WIDTHS[:-1]]
            self.down = nn.ModuleList(
                nn.Sequential(convolution(i, o), convolution(o, o)) for i, o in zip(before, WIDTHS, strict=True)
            )
            self.across = nn.ModuleList(nn.Conv2d(o, i, 1) for i, o in pairwise(WIDTHS))
            self.up = nn.ModuleList(convolution(w, w) for w in WIDTHS[:-1])
            self.out = nn.Conv2d(WIDTHS[0], 12, 1)

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
    """The weights in the form of `masks.label_network`: kernels (k, k, in, out), with batch normalization folded in."""
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


def _torch() -> Any:
    try:
        import torch  # type: ignore[import-not-found,unused-ignore]
    except ImportError:
        raise UsageError("training the label network needs PyTorch: pip install torch") from None
    return torch
