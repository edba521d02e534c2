"""What the engine costs a node, beside pipefunc, Hamilton, Dask and joblib.Memory, in one run on one machine.

    pip install '.[bench]' && python tests/bench/engine_overhead.py

The graph has 10 layers of 100 nodes, each adding three nodes of the layer above; 100 leaves are given and all sinks
asked for. `cold` computes everything, `warm` asks again for the same, `dirty` again with one leaf changed that reaches
about 12 % of the nodes. Times are CPU time of this process (other load on the machine matters less), best of several.
"""

from __future__ import annotations

import argparse
import gc
import importlib.util
import logging
import sys
import tempfile
import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from hashlib import blake2b
from pathlib import Path
from typing import Any

LAYERS, WIDTH, FAN_IN = 10, 100, 3


@dataclass(frozen=True)
class Layered:
    """`parents[name]` are the three names a node adds; leaves are x0..x99."""

    leaves: list[str]
    parents: dict[str, list[str]]
    sinks: list[str]
    changed: str

    @classmethod
    def make(cls, layers: int, width: int) -> Layered:
        leaves = [f"x{i}" for i in range(width)]
        parents: dict[str, list[str]] = {}
        above = leaves
        for layer in range(layers):
            names = [f"n{layer}_{i}" for i in range(width)]
            for i, name in enumerate(names):
                parents[name] = [above[(i + step) % width] for step in range(FAN_IN)]
            above = names
        return cls(leaves, parents, above, leaves[0])

    def reached(self, leaf: str) -> float:
        """The share of nodes below a leaf."""
        dirty = {leaf}
        for name, above in self.parents.items():
            if not dirty.isdisjoint(above):
                dirty.add(name)
        return (len(dirty) - 1) / len(self.parents)


def add(a: float, b: float, c: float) -> float:
    return (a + b + c) / 3


def graphface_yaml(graph: Layered) -> str:
    lines = ["graphface: 1", "inputs:", *(f"  {leaf}: float" for leaf in graph.leaves), "nodes:"]
    for name, (a, b, c) in graph.parents.items():
        lines += [f"  {name}:", "    use: bench.add", f"    in: {{a: {a}, b: {b}, c: {c}}}"]
    lines += ["outputs:", *(f"  {sink}: {sink}" for sink in graph.sinks)]
    return "\n".join(lines) + "\n"


def run_graphface(graph: Layered) -> Iterator[tuple[str, float]]:
    from graphface import Evaluator, MemoryTier, Registry, load, node

    registry = Registry()
    registry.add(node("bench.add")(add))
    text = graphface_yaml(graph)
    yield "build", best(lambda: load(text, registry=registry), 3)
    loaded = load(text, registry=registry)
    values = {leaf: float(i) for i, leaf in enumerate(graph.leaves)}
    yield "cold", best(lambda: loaded.run(evaluator=Evaluator(memory=MemoryTier()), **values), 5)
    evaluator = Evaluator(memory=MemoryTier())
    loaded.run(evaluator=evaluator, **values)
    yield "warm", best(lambda: loaded.run(evaluator=evaluator, **values), 5)
    other = iter(range(1000, 2000))
    yield "dirty", best(lambda: loaded.run(evaluator=evaluator, **values | {graph.changed: float(next(other))}), 5)


def run_bare(graph: Layered) -> Iterator[tuple[str, float]]:
    """The least that memoization by Merkle keys can cost in Python: no graph file, no types, no trace."""
    memo: dict[bytes, float] = {}

    def run(values: dict[str, float]) -> dict[str, float]:
        keys = {name: blake2b(repr(value).encode(), digest_size=16).digest() for name, value in values.items()}
        done = dict(values)
        for name, (a, b, c) in graph.parents.items():
            key = keys[name] = blake2b(b"add" + keys[a] + keys[b] + keys[c], digest_size=16).digest()
            if key not in memo:
                memo[key] = add(done[a], done[b], done[c])
            done[name] = memo[key]
        return {sink: done[sink] for sink in graph.sinks}

    yield from _three(graph, run, memo.clear)


def run_pipefunc(graph: Layered) -> Iterator[tuple[str, float]]:
    from pipefunc import PipeFunc, Pipeline

    def build() -> Any:
        functions = []
        for name, (a, b, c) in graph.parents.items():
            functions.append(PipeFunc(add, name, renames={"a": a, "b": b, "c": c}, cache=True))
        return Pipeline(functions, cache_type="lru", cache_kwargs={"max_size": 100_000, "shared": False})

    start = time.process_time()
    pipeline = build()
    yield "build", time.process_time() - start
    yield from _three(graph, lambda values: pipeline.run(graph.sinks, kwargs=values), pipeline.cache.clear)


def run_hamilton(graph: Layered) -> Iterator[tuple[str, float]]:
    """Its functions come from a real module: it hashes their source, and caches nothing of a function without one."""
    from hamilton import driver

    lines = []
    for name, (a, b, c) in graph.parents.items():
        lines += [f"def {name}({a}: float, {b}: float, {c}: float) -> float:", f"    return ({a} + {b} + {c}) / 3", ""]
    logging.getLogger("hamilton").setLevel(logging.ERROR)
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "layered_functions.py"
        path.write_text("\n".join(lines))
        spec = importlib.util.spec_from_file_location("layered_functions", path)
        assert spec is not None
        assert spec.loader is not None
        module = importlib.util.module_from_spec(spec)
        sys.modules["layered_functions"] = module
        spec.loader.exec_module(module)
        start = time.process_time()
        built = driver.Builder().with_modules(module).with_cache(path=folder).build()
        yield "build", time.process_time() - start
        yield from _three(graph, lambda values: built.execute(graph.sinks, inputs=values), None, repeat=2)


def run_dask(graph: Layered) -> Iterator[tuple[str, float]]:
    import dask.threaded

    def run(values: dict[str, float]) -> Any:
        work: dict[str, Any] = dict(values)
        for name, above in graph.parents.items():
            work[name] = (add, *above)
        return dask.threaded.get(work, graph.sinks)

    yield from _three(graph, run, lambda: None)


def run_joblib(graph: Layered) -> Iterator[tuple[str, float]]:
    from joblib import Memory

    with tempfile.TemporaryDirectory() as folder:
        cached = Memory(folder, verbose=0).cache(add)

        def run(values: dict[str, float]) -> dict[str, float]:
            done = dict(values)
            for name, (a, b, c) in graph.parents.items():
                done[name] = cached(done[a], done[b], done[c])
            return done

        yield from _three(graph, run, None, repeat=1)


def best(run: Callable[[], Any], repeat: int) -> float:
    """Seconds of CPU, the least of `repeat` runs."""
    found = []
    for _ in range(repeat):
        gc.collect()
        start = time.process_time()
        run()
        found.append(time.process_time() - start)
    return min(found)


def _three(
    graph: Layered, run: Callable[[dict[str, float]], Any], forget: Callable[[], Any] | None, repeat: int = 3
) -> Iterator[tuple[str, float]]:
    """Cold, warm and dirty of one function from leaves to sinks; it can be cold once where nothing makes it forget."""
    values = {leaf: float(i) for i, leaf in enumerate(graph.leaves)}

    def cold() -> None:
        if forget is not None:
            forget()
        run(values)

    yield "cold", best(cold, repeat if forget is not None else 1)
    yield "warm", best(lambda: run(values), repeat)
    other = iter(range(1000, 2000))
    yield "dirty", best(lambda: run(values | {graph.changed: float(next(other))}), repeat)


CONTENDERS: dict[str, tuple[str, Callable[[Layered], Iterator[tuple[str, float]]]]] = {
    "graphface": ("graphface", run_graphface),
    "bare Merkle loop": ("hashlib", run_bare),
    "pipefunc, LRU": ("pipefunc", run_pipefunc),
    "Hamilton, cached": ("hamilton", run_hamilton),
    "Dask threads": ("dask", run_dask),
    "joblib.Memory": ("joblib", run_joblib),
}


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--layers", type=int, default=LAYERS)
    parser.add_argument("--only", action="append", help="a contender's name; may be repeated")
    arguments = parser.parse_args()
    graph = Layered.make(arguments.layers, WIDTH)
    nodes = len(graph.parents)
    print(f"{nodes} nodes, {graph.reached(graph.changed):.0%} dirtied; microseconds of CPU a node")
    print(f"{'':18s} {'build':>9s} {'cold':>9s} {'warm':>9s} {'dirty':>9s}")
    for name, (module, run) in CONTENDERS.items():
        if arguments.only and name not in arguments.only:
            continue
        if importlib.util.find_spec(module) is None:
            print(f"{name:18s} not installed (pip install '.[bench]')")
            continue
        found = {what: seconds / nodes * 1e6 for what, seconds in run(graph)}
        shown = (f"{found[w]:9.1f}" if w in found else f"{'-':>9s}" for w in ("build", "cold", "warm", "dirty"))
        print(f"{name:18s} " + " ".join(shown), flush=True)
    return 0


if __name__ == "__main__":
    sys.exit(main())
