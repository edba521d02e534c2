"""Training of the label network with PyTorch, which only this module needs."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from graphface.nodes.learning.unet_training import torch_module, trainable
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
    torch = torch_module()
    torch.manual_seed(seed)
    random = np.random.default_rng(seed)
    net = trainable(CHANNELS, WIDTHS).to(memory_format=torch.channels_last).train()
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
