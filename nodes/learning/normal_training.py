"""Training of the network of `surface.refined` with PyTorch: normals and cast shadows together."""

from __future__ import annotations

import time
from dataclasses import dataclass, fields
from typing import Any

import numpy as np
from numpy.typing import NDArray

from graphface.nodes.learning.unet_training import torch_module, trainable
from graphface.nodes.surface.normal_network import (
    CHANNELS,
    COLORS,
    COVERAGE,
    LIGHT,
    NORMALS,
    OF_PICTURE,
    OUTPUTS,
    PLACE,
    WIDTHS,
)

BATCH, RATE, DECAY = 8, 3e-3, 1e-2
"""Pictures in a step; largest learning rate and weight decay of AdamW."""


BLIND = 0.15
"""Share of pictures that are blanked: what can be said without the picture is learned as well, and can be measured."""


_SLOPES = 0.5
"""Weight of the error's differences between neighboring pixels, beside the error."""

_SHADOW = 0.5
"""Weight of the shadow's cross entropy beside the normals' error."""

_KEPT_BACK = 12
"""Every twelfth example is kept back: nothing is learned from it, the network is measured on it."""

_MIRRORED = [NORMALS, LIGHT, PLACE]


@dataclass(frozen=True)
class Pictures:
    """Lessons as `normal_lessons.Lesson` describes them, stacked: float16 (N, S, S) or (N, S, S, channels)."""

    seen: NDArray[np.float16]
    normals: NDArray[np.float16]
    weight: NDArray[np.float16]
    shadow: NDArray[np.float16]
    lit: NDArray[np.float16]

    def chosen(self, indices: NDArray[np.int64]) -> list[NDArray[np.float32]]:
        """The five arrays of some lessons, float32 (n, S, S, channels)."""
        own = [getattr(self, part.name)[indices].astype(np.float32) for part in fields(self)]
        return [part if part.ndim == 4 else part[..., None] for part in own]


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
    net = trainable(4 * CHANNELS, WIDTHS, OUTPUTS).to(memory_format=torch.channels_last).train()
    torch.nn.init.zeros_(net.out.weight)
    optimizer = torch.optim.AdamW(net.parameters(), lr=RATE, weight_decay=DECAY)
    start, step, running = time.monotonic(), 0, 0.0
    while (passed := (time.monotonic() - start) / max(60 * minutes, 1e-3)) < 1 or step < 2:
        for group in optimizer.param_groups:
            group["lr"] = max(RATE * min(1, passed / 0.1) * 0.5 * (1 + np.cos(np.pi * min(passed, 1))), 1e-5)
        loss = _loss(torch, net, *_batch(torch, pictures.chosen(random.choice(taught, BATCH)), random))
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
        "shadows_kept_back": _shadows_found(torch, net, pictures, kept_back),
    }
    return {name: values.clone() for name, values in net.state_dict().items()}, figures


def _batch(torch: Any, parts: list[NDArray[np.float32]], random: np.random.Generator) -> tuple[Any, ...]:
    """Augmented lessons, channels first: mirrored, blanked, of other contrast, grey, blurred."""
    seen, normals, _, _, lit = parts
    for index in range(len(seen)):
        if random.random() < 0.5:
            for part in parts:
                part[index] = part[index][:, ::-1]
            seen[index][..., _MIRRORED] *= -1
            normals[index][..., 0] *= -1
        if random.random() < BLIND:
            seen[index][..., OF_PICTURE] = 0
            lit[index] = 0
        else:
            seen[index][..., COLORS:NORMALS] = _varied(seen[index][..., COLORS:NORMALS], random)
    return tuple(_first(torch, part) for part in parts)


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


def _said(torch: Any, net: Any, seen: Any) -> tuple[Any, Any]:
    """Refined normals, and the logit of the shadow."""
    cells = torch.nn.functional.pixel_unshuffle(seen, 2).contiguous(memory_format=torch.channels_last)
    said = net(cells)
    return _unit(seen[:, NORMALS:COVERAGE] + said[:, :3]), said[:, 3:]


def _unit(vectors: Any) -> Any:
    return vectors / vectors.norm(dim=1, keepdim=True).clamp(min=1e-3)


def _loss(torch: Any, net: Any, seen: Any, normals: Any, weight: Any, shadow: Any, lit: Any) -> Any:
    """The length of the normals' error, about an angle in radians, and of its slopes; cross entropy of the shadow."""
    refined, logit = _said(torch, net, seen)
    error = refined - _unit(normals)
    total = weight.sum().clamp(min=1)
    length = (error.square().sum(dim=1, keepdim=True) + 1e-6).sqrt()
    across = (error[..., 1:] - error[..., :-1]).abs().sum(dim=1, keepdim=True) * weight[..., 1:] * weight[..., :-1]
    down = error[..., 1:, :] - error[..., :-1, :]
    down = down.abs().sum(dim=1, keepdim=True) * weight[..., 1:, :] * weight[..., :-1, :]
    entropy = torch.nn.functional.binary_cross_entropy_with_logits(logit, shadow, reduction="none")
    of_shadow = (entropy * lit).sum() / lit.sum().clamp(min=1)
    return ((length * weight).sum() + _SLOPES * (across.sum() + down.sum())) / total + _SHADOW * of_shadow


def _degrees(torch: Any, net: Any, pictures: Pictures, chosen: NDArray[np.int64], blind: bool) -> float:
    """Mean angle to the true normals on skin, of the fitted normals without a net."""
    found = []
    with torch.no_grad():
        for start in range(0, len(chosen), BATCH):
            own = chosen[start : start + BATCH]
            seen, normals, weight, _, _ = (_first(torch, part) for part in pictures.chosen(own))
            fitted = _unit(seen[:, NORMALS:COVERAGE])
            if blind:
                seen[:, list(OF_PICTURE)] = 0
            after = fitted if net is None else _said(torch, net, seen)[0]
            angle = torch.rad2deg(torch.arccos((after * _unit(normals)).sum(dim=1).clamp(-1, 1)))
            found += [float(a[w[0] > 0.5].mean()) for a, w in zip(angle, weight, strict=True) if (w > 0.5).any()]
    return round(float(np.mean(found)), 3)


def _shadows_found(torch: Any, net: Any, pictures: Pictures, chosen: NDArray[np.int64]) -> dict[str, float]:
    """Share of true cast shadow that is found, and share of what is found that is true."""
    right = true = found = 0.0
    with torch.no_grad():
        for start in range(0, len(chosen), BATCH):
            seen, _, _, shadow, lit = (_first(torch, part) for part in pictures.chosen(chosen[start : start + BATCH]))
            said = (_said(torch, net, seen)[1] > 0) * lit
            right += float((said * (shadow > 0.5)).sum())
            true += float((lit * (shadow > 0.5)).sum())
            found += float(said.sum())
    return {"recall": round(right / max(true, 1e-6), 3), "precision": round(right / max(found, 1e-6), 3)}
