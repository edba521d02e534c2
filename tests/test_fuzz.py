"""Whatever stands in a graph file, loading it works or raises a `GraphfaceError`: never a traceback, never a hang.

`GRAPHFACE_FUZZ=20000 pytest tests/test_fuzz.py` runs the long version.
"""

import contextlib
import os
import random
from pathlib import Path

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from toys import toy_registry

from graphface import GraphfaceError, Registry, load
from graphface.document.flags import read_flag

EXAMPLES = int(os.environ.get("GRAPHFACE_FUZZ", "300"))
SHIPPED = Path(__file__).resolve().parents[1] / "graphs"
REGISTRY: Registry = toy_registry()

SEEDS = [
    """graphface: 1
name: seed
extends: base.yaml
inputs: {x: {type: float | None, default: 2}, g: Grid}
nodes:
  a: {use: toy.add, in: {a: x, b: [n]}, with: {plus: 1e0, label: &l 'text'}}
  p: {use: toy.pair, in: {grid: g}, doc: *l}
  m: {use: toy.mean, in: {grid: p.low}}
  q: {use: other.yaml, in: {x: a}, with: {n.value: [1, {k: ~}]}}
  gone: null
outputs: {y: a, z: q/n}
variants: {v: {a: {use: toy.subtract}, q/n: null}}
profiles: {draft: {a: {plus: 3}}}
""",
    """graphface: 1
nodes:
  n: {use: toy.number, with: {value: 0x1F}}
  t: {use: toy.total, in: {values: [n, n]}}
  o: {use: toy.options, with: {table: {a: [1, 2]}, items: [.inf, -.nan, 2024-01-01]}}
  g: {use: toy.gate, in: {a: n, extra: t}, with: {open: false}}
outputs:
  y: g
""",
]
TOKENS = (
    "{", "}", "[", "]", ":", ": ", ",", "\n", "\n  ", "&a ", "*a", "!!python/object:x ", "? ", "- ", "|", ">", "'", '"',
    "#", "null", "~", "\t", "\x00", "\x85", "\u2028", "\ud800", "é", "\U0001f600", "9" * 5000, "0x" + "f" * 9000,
    "1e999", "..", "../x.yaml", "a.yaml", "/etc/passwd", "list[" * 40, "|" * 20, "[" * 70, "<<", "%YAML 9.9\n",
    "---\n", "...\n", "use", "in", "with", "extends: self.yaml\n", "toy.add", "toy.options", "graphface: 1\n",
)  # fmt: skip


def try_to_load(path: Path, registry: Registry, **choices: object) -> None:
    """Load a graph; what it is refused with must be printable."""
    try:
        graph = load(path, registry=registry, **choices)
    except GraphfaceError as error:
        assert str(error).strip()  # noqa: PT017 - both outcomes are fine, this one has to be readable
    else:
        graph.targets()


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("fuzz")
    (folder / "other.yaml").write_text(
        "graphface: 1\ninputs: {x: float}\noutputs: {y: m}\n"
        "nodes: {n: {use: toy.number}, m: {use: toy.add, in: {a: x}}}\n"
    )
    (folder / "base.yaml").write_text("graphface: 1\nnodes: {n: {use: toy.number}}\n")
    return folder


@st.composite
def edited(draw: st.DrawFn) -> str:
    """A seed with pieces cut out, doubled, moved and replaced by hostile ones."""
    text = draw(st.sampled_from(SEEDS))
    for _ in range(draw(st.integers(1, 6))):
        start = draw(st.integers(0, len(text)))
        end = min(len(text), start + draw(st.integers(0, 30)))
        piece = draw(st.one_of(st.just(""), st.sampled_from(TOKENS), st.just(text[start:end] * 2), st.text(max_size=4)))
        text = text[:start] + piece + text[end:]
    return text


@settings(max_examples=EXAMPLES, deadline=None, suppress_health_check=list(HealthCheck))
@given(edited(), st.booleans())
def test_edited_texts(folder: Path, text: str, overlays: bool) -> None:
    """Texts edited by a hostile hand."""
    path = folder / "g.yaml"
    path.write_bytes(text.encode("utf-8", "surrogatepass"))
    choices = {"variants": ["v"], "profiles": ["draft"], "set": {"q/n.value": 3}} if overlays else {}
    try_to_load(path, REGISTRY, **choices)


@settings(max_examples=EXAMPLES, deadline=None, suppress_health_check=list(HealthCheck))
@given(st.sampled_from(SEEDS), st.randoms(use_true_random=False))
def test_spoilt_bytes(folder: Path, seed: str, rng: random.Random) -> None:
    """Texts with some bytes changed, dropped or repeated."""
    path = folder / "b.yaml"
    path.write_bytes(spoil(seed.encode(), rng))
    try_to_load(path, REGISTRY)


@settings(max_examples=EXAMPLES, deadline=None, suppress_health_check=list(HealthCheck))
@given(st.one_of(edited(), st.text(max_size=40)))
def test_flags(text: str) -> None:
    """Values of flags."""
    with contextlib.suppress(GraphfaceError):
        read_flag(f"a.b={text[:200]}", "--set")


def shipped() -> list[Path]:
    return sorted(SHIPPED.glob("*.yaml"))


@pytest.mark.parametrize("path", shipped(), ids=lambda p: p.stem)
def test_shipped_graphs(folder: Path, path: Path) -> None:
    """The shipped graphs with bytes spoilt, checked against the installed operators."""
    from graphface.registry import default_registry

    registry, rng, text = default_registry(), random.Random(path.stem), path.read_bytes()
    spoilt = folder / path.name
    for _ in range(max(20, EXAMPLES // 10)):
        spoilt.write_bytes(spoil(text, rng))
        try_to_load(spoilt, registry)


def spoil(data: bytes, rng: random.Random) -> bytes:
    """A few bytes changed, dropped, repeated or moved."""
    spoilt = bytearray(data)
    for _ in range(rng.randint(1, 8)):
        at = rng.randrange(len(spoilt) + 1)
        match rng.randrange(5):
            case 0:
                spoilt[at : at + 1] = bytes([rng.randrange(256)])
            case 1:
                del spoilt[at : at + rng.randint(1, 12)]
            case 2:
                spoilt[at:at] = spoilt[at : at + rng.randint(1, 40)]
            case 3:
                spoilt[at:at] = rng.choice(TOKENS).encode("utf-8", "surrogatepass")
            case 4:
                other = rng.randrange(len(spoilt) + 1)
                spoilt[at:at] = spoilt[other : other + rng.randint(1, 40)]
    return bytes(spoilt)
