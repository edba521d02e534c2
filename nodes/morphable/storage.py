"""A face model on disk: NAME.safetensors with the arrays, and a card NAME.json beside it.

Tensors: `mean` (V, 3), `triangles` (T, 3), `identity` and `expression` (K, V, 3) with `*_deviations` (K,),
`landmarks.SCHEME` (n,), and where present `uv` (V, 2), `parts` (V,), `prior.weights`, `prior.means`,
`prior.covariances`. Lengths are in outer-eye-corner distances, directions in standard deviations (see `model`).
Directions may be float16. The card has `format`, `name`, `identity_names`, `expression_names`, `part_names`, and the
origin: `source`, `license`, `learned_from`, `limits`. With `refine` = n in the card the file holds a coarse mesh, which
is subdivided n times when it is read.
"""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from graphface import UnreadableFile, UnwritableFile
from graphface.nodes.morphable.model import Basis, InvalidModel, MorphableModel
from graphface.nodes.morphable.prior import Mixture
from graphface.nodes.morphable.subdivide import loop

FORMAT = "graphface-morphable-1"


_CARD_FIELDS = ("format", "name", "identity_names", "expression_names", "part_names")


def load_model(path: Path, *, refine: bool = True) -> MorphableModel:
    """Read a model written by `save_model`; its mesh is subdivided as the card says.

    Args:
        refine: False keeps the coarse mesh of the file, to be edited and saved again.

    Raises:
        UnreadableFile: a file is missing or damaged, or its parts do not agree.
    """
    from safetensors import SafetensorError
    from safetensors.numpy import load_file

    path = Path(path)
    card_path = path.with_suffix(".json")
    try:
        tensors = load_file(path)
        card = json.loads(card_path.read_text(encoding="utf-8"))
    except FileNotFoundError as error:
        raise UnreadableFile(
            error.filename or path, "no such file; a face model is NAME.safetensors and NAME.json"
        ) from None
    except (OSError, ValueError, SafetensorError) as error:
        raise UnreadableFile(path, f"not a face model: {error}") from error
    if not isinstance(card, dict) or card.get("format") != FORMAT:
        raise UnreadableFile(card_path, f"its format is not {FORMAT!r}; use `graphface models import`")
    try:
        model = _assembled(tensors, card)
    except KeyError as error:
        raise UnreadableFile(path, f"lacks {error.args[0]!r}") from None
    except InvalidModel as error:
        raise UnreadableFile(path, error.reason) from error
    levels = int(card.get("refine", 0))
    return refined(model, levels) if levels and refine else model


def save_model(model: MorphableModel, path: Path, *, half: bool = False) -> None:
    """Write `path` (.safetensors) and the card beside it; `half` stores the directions as float16.

    Raises:
        UnwritableFile: another suffix, or the folder refuses.
    """
    from safetensors.numpy import save_file

    path = Path(path)
    if path.suffix != ".safetensors":
        raise UnwritableFile(path, "a face model is written as NAME.safetensors (and NAME.json)")
    tensors = _tensors(model, np.float16 if half else np.float32)
    card = {
        "format": FORMAT,
        "name": model.name,
        **model.card,
        "identity_names": list(model.identity.names),
        "expression_names": list(model.expression.names),
        "part_names": list(model.part_names),
    }
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        save_file(tensors, path)
        path.with_suffix(".json").write_text(json.dumps(card, indent=2) + "\n", encoding="utf-8")
    except OSError as error:
        raise UnwritableFile(path, error.strerror or str(error)) from error


def _tensors(model: MorphableModel, kind_of_float: type[np.floating[Any]]) -> dict[str, NDArray[Any]]:
    """The arrays of a model by their names in the file; directions and covariances in the given type."""
    tensors: dict[str, NDArray[Any]] = {"mean": model.mean, "triangles": model.triangles}
    for kind, basis in (("identity", model.identity), ("expression", model.expression)):
        tensors[kind] = basis.directions.astype(kind_of_float)
        tensors[f"{kind}_deviations"] = basis.deviations
    tensors.update({f"landmarks.{scheme}": vertices for scheme, vertices in model.landmarks.items()})
    tensors.update({k: v for k, v in (("uv", model.uv), ("parts", model.parts)) if v is not None})
    if model.prior is not None:
        mixture = model.prior
        tensors["prior.weights"], tensors["prior.means"] = mixture.weights, mixture.means
        tensors["prior.covariances"] = mixture.covariances.astype(kind_of_float)
    return {name: np.ascontiguousarray(tensor) for name, tensor in tensors.items()}


def refined(model: MorphableModel, levels: int) -> MorphableModel:
    """The same model on a mesh that is subdivided `levels` times; the old vertices keep their numbers."""
    matrix, triangles = loop(model.triangles, len(model.mean), levels)
    finer = matrix.toarray().astype(np.float32)

    def of(basis: Basis) -> Basis:
        return replace(basis, directions=np.matmul(finer, basis.directions))

    return replace(
        model,
        mean=(matrix @ model.mean.astype(np.float64)).astype(np.float32),
        triangles=triangles,
        identity=of(model.identity),
        expression=of(model.expression),
        uv=None if model.uv is None else finer @ model.uv,
        parts=None if model.parts is None else model.parts[finer.argmax(axis=1)],
    )


def _assembled(tensors: Mapping[str, Any], card: Mapping[str, Any]) -> MorphableModel:
    def basis(kind: str) -> Basis:
        directions = tensors[kind].astype(np.float32)
        names = card.get(f"{kind}_names") or [f"{kind}{k}" for k in range(len(directions))]
        return Basis(directions, tensors[f"{kind}_deviations"].astype(np.float32), tuple(names))

    prior = None
    if "prior.means" in tensors:
        parts = (tensors[f"prior.{part}"].astype(np.float32) for part in ("weights", "means", "covariances"))
        prior = Mixture(*parts)
    prefix = "landmarks."
    return MorphableModel(
        name=str(card["name"]),
        mean=tensors["mean"].astype(np.float32),
        triangles=tensors["triangles"].astype(np.int32),
        identity=basis("identity"),
        expression=basis("expression"),
        landmarks={k.removeprefix(prefix): v.astype(np.int32) for k, v in tensors.items() if k.startswith(prefix)},
        uv=tensors.get("uv"),
        parts=tensors.get("parts"),
        part_names=tuple(card.get("part_names", ())),
        prior=prior,
        card={k: v for k, v in card.items() if k not in _CARD_FIELDS},
    )
