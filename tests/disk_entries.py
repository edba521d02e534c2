"""Keys and a value for a disk cache, and where it keeps them."""

from pathlib import Path

import numpy as np

from graphface.cache.disk import DiskTier

KEY = bytes(range(16))
OTHER = bytes(reversed(range(16)))
ARRAY = np.arange(300, dtype=np.float32).reshape(10, 10, 3)
MIB = 1 << 20


def entry_of(tier: DiskTier, key: bytes = KEY) -> Path:
    return tier.folder / key.hex()[:2] / f"{key.hex()}.safetensors"
