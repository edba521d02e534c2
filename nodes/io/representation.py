"""A representation as one file.

Computed once, it can be edited anywhere: `graphface run represent -i photo=a.jpg -o representation=a.face` writes it,
`graphface run relight-saved -i saved=a.face -o b.png` starts from it, with nothing to detect or to fit.
"""

from __future__ import annotations

import json
from pathlib import Path

from graphface import UnreadableFile, UnwritableFile
from graphface.nodes.types import (
    Representation,
)

_FORMAT = "graphface representation 1"


def read_representation(path: Path) -> Representation:
    """Read what `write_representation` wrote.

    Raises:
        UnreadableFile: not there, not a representation, or written by another version of these types.
    """
    from safetensors import SafetensorError, safe_open

    from graphface.values.codec import CodecError, decode

    path = Path(path)
    if not path.is_file():
        raise UnreadableFile(path, "no such file")
    try:
        with safe_open(path, framework="numpy") as file:
            words = file.metadata() or {}
            tensors = {name: file.get_tensor(name) for name in file.keys()}  # noqa: SIM118 - not a mapping
        if words.get("format") != _FORMAT:
            raise UnreadableFile(path, f"not a {_FORMAT!r} file")
        found: Representation = decode(tensors, json.loads(words["structure"]), Representation)
    except (SafetensorError, CodecError, ValueError, KeyError, OSError) as error:
        raise UnreadableFile(path, f"damaged, or no representation ({error})") from None
    return found


def write_representation(representation: Representation, path: Path) -> None:
    """Write as safetensors: arrays as they are, everything else as JSON in the header; about 150 bytes a pixel.

    Raises:
        UnwritableFile: the folder cannot be written to.
    """
    from safetensors import SafetensorError
    from safetensors.numpy import save_file

    from graphface.values.codec import encode
    from graphface.values.writing import beside

    tensors, structure = encode(representation)
    words = {"format": _FORMAT, "structure": json.dumps(structure)}
    with beside(Path(path)) as temporary:
        try:
            save_file(tensors, temporary, words)
        except (SafetensorError, OSError) as error:
            raise UnwritableFile(path, str(error)) from None
