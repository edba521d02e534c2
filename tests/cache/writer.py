"""Writes entries for ever, for tests that kill it: `python writer.py FOLDER SEED BUDGET`."""

import random
import sys

import numpy as np

from graphface.cache.disk import DiskTier

KEYS = 40


def key(number: int) -> bytes:
    return number.to_bytes(1, "big") * 16


def value(number: int) -> np.ndarray:
    """What the entry of this number must hold; sizes from 4 bytes to 400 kB."""
    return np.full(1 + number * number * 64, number, np.float32)


if __name__ == "__main__":
    tier = DiskTier(sys.argv[1], int(sys.argv[3]), report=lambda message: print(message, flush=True))
    chance = random.Random(int(sys.argv[2]))
    rounds = int(sys.argv[4]) if len(sys.argv) > 4 else -1
    print("ready", flush=True)
    while rounds:
        rounds -= 1
        number = chance.randrange(KEYS)
        found = tier.get(key(number), np.ndarray) if chance.random() < 0.5 else None
        if isinstance(found, np.ndarray):
            if not np.array_equal(found, value(number)):
                sys.exit("a wrong value was served")
        else:
            tier.put(key(number), value(number), cost_seconds=chance.random())
