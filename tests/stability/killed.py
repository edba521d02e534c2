"""Runs one graph on one cache folder until killed: `python killed.py FOLDER SEED [ROUNDS]`.

Every result is compared with what it must be, so a wrong value served from the cache ends the process with a message.
Started with "spawn" as third argument it waits for lines of "seed" on standard input and forks a child for each, whose
process id it prints: a kill then costs a fork and not a new interpreter.
"""

from __future__ import annotations

import os
import random
import sys
from pathlib import Path

import numpy as np

from graphface import Evaluator, MemoryTier, Registry, load, node
from graphface.cache.disk import DiskTier

LAYERS, WIDTH = 5, 4
BUDGET = 3_000_000
"""Bytes: less than all values of a few seeds take, so that eviction goes on all the time."""


@node("killed.leaf")
def leaf(seed: int, *, column: int) -> np.ndarray:
    return np.full((32, 32 * (1 + column)), float(seed * 10 + column))


@node("killed.mix")
def mix(a: np.ndarray, b: np.ndarray, *, add: float) -> np.ndarray:
    return np.full(a.shape, a[0, 0] * 0.5 + b[0, 0] * 0.25 + add)


def registry() -> Registry:
    found = Registry()
    found.add(leaf)
    found.add(mix)
    return found


def graph_text() -> str:
    lines = ["graphface: 1", "name: killed", "inputs: {seed: int}", "nodes:"]
    for column in range(WIDTH):
        lines.append(f"  n0_{column}: {{use: killed.leaf, in: {{seed: seed}}, with: {{column: {column}}}}}")
    for layer in range(1, LAYERS):
        for column in range(WIDTH):
            a, b = f"n{layer - 1}_{column}", f"n{layer - 1}_{(column + 1) % WIDTH}"
            lines.append(f"  n{layer}_{column}: {{use: killed.mix, in: {{a: {a}, b: {b}}}, with: {{add: {layer}}}}}")
    lines.append(f"outputs: {{{', '.join(f'o{c}: n{LAYERS - 1}_{c}' for c in range(WIDTH))}}}")
    return "\n".join(lines) + "\n"


def truth(seed: int) -> list[float]:
    """What the outputs hold, computed without the engine."""
    values = [float(seed * 10 + column) for column in range(WIDTH)]
    for layer in range(1, LAYERS):
        values = [values[c] * 0.5 + values[(c + 1) % WIDTH] * 0.25 + layer for c in range(WIDTH)]
    return values


def check(folder: Path, seed: int, said: list[str]) -> None:
    """One run; exits where an output is not what it must be."""
    disk = DiskTier(folder, BUDGET, said.append)
    result = GRAPH.run(evaluator=Evaluator(memory=MemoryTier(1 << 16), disk=disk, threads=2), seed=seed)
    for column, expected in enumerate(truth(seed)):
        found = result[f"o{column}"]
        if found.shape != (32, 32 * (1 + column)) or not (found == expected).all():
            sys.exit(f"a wrong value was served: seed {seed}, column {column}")


def work(folder: Path, seed: int, rounds: int) -> None:
    chance, said = random.Random(seed), list[str]()
    while rounds:
        rounds -= 1
        check(folder, chance.randrange(6), said)
    for message in said:
        print(message, flush=True)


GRAPH = load(graph_text(), registry=registry())

if __name__ == "__main__":
    where = Path(sys.argv[1])
    if sys.argv[2] != "spawn":
        work(where, int(sys.argv[2]), int(sys.argv[3]) if len(sys.argv) > 3 else -1)
        sys.exit(0)
    for line in sys.stdin:
        child = os.fork()
        if child == 0:
            work(where, int(line), -1)
        print(child, flush=True)
        _, status = os.waitpid(child, 0)
        print(os.WTERMSIG(status) if os.WIFSIGNALED(status) else -1, flush=True)
