"""Evaluators of every kind, with the toy operators, and what they called."""

from dataclasses import dataclass, field
from pathlib import Path

from graphface import Evaluator, Graph, MemoryTier, Registry, Result, load
from graphface.cache.disk import DiskTier

TIERS = ("none", "memory", "disk", "both")
THREADS = (1, 4)


@dataclass
class Lab:
    """One evaluator, and what it called since the last run began."""

    tier: str
    evaluator: Evaluator
    registry: Registry
    ran: list[str]
    loaded: list[Graph] = field(default_factory=list)

    @property
    def keeps(self) -> bool:
        return self.tier != "none"

    def load(self, nodes: str, outputs: str = "", inputs: str = "") -> Graph:
        sections = ["graphface: 1"]
        for name, body in (("inputs", inputs), ("nodes", nodes), ("outputs", outputs)):
            if body:
                sections.append(f"{name}:")
                sections += [f"  {line.strip()}" for line in body.strip().splitlines()]
        return load("\n".join(sections) + "\n", registry=self.registry)

    def run(self, graph: Graph, outputs: list[str], **inputs: object) -> Result:
        self.ran.clear()
        return graph.run(outputs, evaluator=self.evaluator, **inputs)


def build(tier: str, threads: int, folder: Path, registry: Registry, ran: list[str], **options: object) -> Lab:
    memory = MemoryTier() if tier in ("memory", "both") else None
    disk = DiskTier(folder, 1 << 26) if tier in ("disk", "both") else None
    return Lab(tier, Evaluator(memory=memory, disk=disk, threads=threads, **options), registry, ran)  # type: ignore[arg-type]
