"""Models by name: the built-in one and those in the user's model folder, written by `graphface models import`."""

from __future__ import annotations

import os
from pathlib import Path

from graphface import UsageError
from graphface.errors import did_you_mean, nearest_names
from graphface.nodes.morphable.builtin import BUILTIN, builtin_model
from graphface.nodes.morphable.model import MorphableModel
from graphface.nodes.morphable.storage import load_model

FOLDER_VARIABLE = "GRAPHFACE_MODELS"


def model_folder() -> Path:
    """Where imported models lie: $GRAPHFACE_MODELS, or the user's data folder."""
    from platformdirs import user_data_path

    given = os.environ.get(FOLDER_VARIABLE)
    return Path(given) if given else user_data_path("graphface") / "models"


def library() -> dict[str, Path]:
    """Name to file of every available model, the built-in first."""
    imported = sorted(model_folder().glob("*.safetensors"))
    return {"builtin": BUILTIN, **{path.stem: path for path in imported}}


def named_model(name: str) -> MorphableModel:
    """The model of a name in the library, or of a file.

    Raises:
        UsageError: neither, with the nearest names.
        UnreadableFile: the file is no model.
    """
    if name == "builtin":
        return builtin_model()
    known = library()
    if name in known:
        return load_model(known[name])
    if Path(name).suffix == ".safetensors":
        return load_model(Path(name))
    raise UsageError(
        f"no face model {name!r}{did_you_mean(nearest_names(name, known))} "
        "(`graphface models list` shows those available; the name of a .safetensors file works, too)"
    )
