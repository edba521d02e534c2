"""Training of the normals network with PyTorch."""

from __future__ import annotations

import time
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from graphface.nodes.learning.unet_training import torch_module, trainable
from graphface.nodes.surface.normal_network import CHANNELS, COLORS, COVERAGE, LIGHT, NORMALS, OF_PICTURE, PLACE, WIDTHS

BATCH, RATE, DECAY = 8, 3e-3, 1e-2
"""Pictures in a step; largest learning rate and weight decay of AdamW."""


BLIND = 0.15
"""Share of pictures that are blanked: what can be said without the picture is learned as well, and can be measured."""


_SLOPES = 0.5
"""Weight of the error's differences between neighboring pixels, beside the error."""

_KEPT_BACK = 12
"""Every twelfth example is kept back: nothing is learned from it, the network is measured on it."""

_MIRRORED = [NORMALS, LIGHT, PLACE]


@dataclass(frozen=True)
class Pictures:
    """float16: `seen` (N, S, S, CHANNELS), `normals` (N, S, S, 3) and `weight` (N, S, S)."""

    seen: NDArray[np.float16]
    normals: NDArray[np.float16]
    weight: NDArray[np.float16]


def trained(
    pictures: Pictures, *, minutes: float, threads: int = 1, seed: int = 0
) -> tuple[dict[str, Any], dict[str, Any]]:
    """The state of a network, and figures about it; the learning rate follows the time.

    Raises:
        UsageError: PyTorch is not installed.
    """
    torch = torch_module()
    torch.set_num_threads(threads)
    torch.manual_seed(seed)
    random = np.random.default_rng(seed)
    count = len(pictures.seen)
    kept_back = np.arange(0, count, _KEPT_BACK)
    taught = np.setdiff1d(np.arange(count), kept_back)
    net = trainable(4 * CHANNELS, WIDTHS).to(memory_format=torch.channels_last).train()
    torch.nn.init.zeros_(net.out.weight)
    optimizer = torch.optim.AdamW(net.parameters(), lr=RATE, weight_decay=DECAY)
    start, step, running = time.monotonic(), 0, 0.0
    while (passed := (time.monotonic() - start) / max(60 * minutes, 1e-3)) < 1 or step < 2:
        for group in optimizer.param_groups:
            group["lr"] = max(RATE * min(1, passed / 0.1) * 0.5 * (1 + np.cos(np.pi * min(passed, 1))), 1e-5)
        loss = _loss(torch, net, *_batch(torch, pictures, random.choice(taught, BATCH), random))
        optimizer.zero_grad()
        loss.backward()
        torch.nn.utils.clip_grad_norm_(net.parameters(), 1.0)
        optimizer.step()
        running += (float(loss.detach()) - running) * max(0.01, 1 / (step + 1))
        step += 1
        if step % 200 == 0:
            print(f"  {step} steps, {100 * passed:.0f} % of the time, loss {running:.4f}", flush=True)
    net.eval()
    figures = {
        "steps": step,
        "degrees_off_kept_back": {
            "fitted": _degrees(torch, None, pictures, kept_back, False),
            "refined": _degrees(torch, net, pictures, kept_back, False),
            "refined, blind to the picture": _degrees(torch, net, pictures, kept_back, True),
        },
    }
    return {name: values.clone() for name, values in net.state_dict().items()}, figures


def _batch(torch: Any, pictures: Pictures, chosen: NDArray[np.int64], random: np.random.Generator) -> tuple[Any, ...]:
    """Augmented pictures, channels first: mirrored, blanked, of other contrast, grey, blurred."""
    parts = (pictures.seen, pictures.normals, pictures.weight[..., None])
    seen, normals, weight = (part[chosen].astype(np.float32) for part in parts)
    for index in range(len(chosen)):
        if random.random() < 0.5:
            for part in (seen, normals, weight):
                part[index] = part[index][:, ::-1]
            seen[index][..., _MIRRORED] *= -1
            normals[index][..., 0] *= -1
        if random.random() < BLIND:
            seen[index][..., OF_PICTURE] = 0
        else:
            seen[index][..., COLORS:NORMALS] = _varied(seen[index][..., COLORS:NORMALS], random)
    return tuple(_first(torch, part) for part in (seen, normals, weight))


def _varied(colors: NDArray[np.float32], random: np.random.Generator) -> NDArray[np.float32]:
    import cv2

    values = np.maximum(colors + 1, 0)
    if random.random() < 0.3:
        values = np.repeat(values.mean(axis=2, keepdims=True), 3, axis=2)
    values = values ** random.uniform(0.75, 1.35) * random.uniform(0.9, 1.1)
    if random.random() < 0.5:
        values = cv2.GaussianBlur(values, (0, 0), random.uniform(0.4, 1.2))
    if random.random() < 0.3:
        values = values + random.normal(size=values.shape) * random.uniform(0, 0.03)
    return np.asarray(values - 1, np.float32)


def _first(torch: Any, part: NDArray[np.float32]) -> Any:
    return torch.from_numpy(np.ascontiguousarray(part.transpose(0, 3, 1, 2)))


def _refined(torch: Any, net: Any, seen: Any) -> Any:
    cells = torch.nn.functional.pixel_unshuffle(seen, 2).contiguous(memory_format=torch.channels_last)
    return _unit(seen[:, NORMALS:COVERAGE] + net(cells))


def _unit(vectors: Any) -> Any:
    return vectors / vectors.norm(dim=1, keepdim=True).clamp(min=1e-3)


def _loss(torch: Any, net: Any, seen: Any, normals: Any, weight: Any) -> Any:
    """The length of the error, about an angle in radians, and of its slopes."""
    error = _refined(torch, net, seen) - _unit(normals)
    total = weight.sum().clamp(min=1)
    length = (error.square().sum(dim=1, keepdim=True) + 1e-6).sqrt()
    across = (error[..., 1:] - error[..., :-1]).abs().sum(dim=1, keepdim=True) * weight[..., 1:] * weight[..., :-1]
    down = error[..., 1:, :] - error[..., :-1, :]
    down = down.abs().sum(dim=1, keepdim=True) * weight[..., 1:, :] * weight[..., :-1, :]
    return ((length * weight).sum() + _SLOPES * (across.sum() + down.sum())) / total


def _degrees(torch: Any, net: Any, pictures: Pictures, chosen: NDArray[np.int64], blind: bool) -> float:
    """Mean angle to the true normals on skin, of the fitted normals without a net."""
    found = []
    with torch.no_grad():
        for start in range(0, len(chosen), BATCH):
            own = chosen[start : start + BATCH]
            seen, normals, weight = (
                _first(torch, part[own].astype(np.float32))
                for part in (pictures.seen, pictures.normals, pictures.weight[..., None])
            )
            fitted = _unit(seen[:, NORMALS:COVERAGE])
            if blind:
                seen[:, list(OF_PICTURE)] = 0
            after = fitted if net is None else _refined(torch, net, seen)
            angle = torch.rad2deg(torch.arccos((after * _unit(normals)).sum(dim=1).clamp(-1, 1)))
            found += [float(a[w[0] > 0.5].mean()) for a, w in zip(angle, weight, strict=True) if (w > 0.5).any()]
    return round(float(np.mean(found)), 3)
