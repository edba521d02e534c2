"""Who imports whom, read from the sources, held against the layers of pyproject.toml, and drawn.

    python tests/layers.py          writes .github/layers.svg

The layers themselves stand in one place: import-linter's contracts in pyproject.toml, exceptions included. Imports
inside functions count, and those for types only. `test_layers.py` checks what this module finds.
"""

from __future__ import annotations

import ast
import tomllib
from collections.abc import Iterator, Mapping
from fnmatch import fnmatchcase
from html import escape
from importlib.util import resolve_name
from pathlib import Path
from typing import Any

import networkx as nx

ROOT = Path(__file__).resolve().parents[1]
DRAWING = ROOT / ".github" / "layers.svg"
FOLDERS = {"graphface": "graphface", "nodes": "graphface.nodes", "graphs": "graphface.graphs"}
"""The folders of the checkout, and the packages as which they are installed."""


def source_files() -> dict[str, Path]:
    """Every module by its name as installed."""
    found = {}
    for folder, package in FOLDERS.items():
        for path in sorted((ROOT / folder).rglob("*.py")):
            parts = path.relative_to(ROOT / folder).with_suffix("").parts
            found[".".join([package, *(part for part in parts if part != "__init__")])] = path
    return found


def import_graph() -> nx.DiGraph:
    """An edge from every module to each module of graphface that it imports, the exceptions of pyproject left out."""
    files = source_files()
    graph = nx.DiGraph()
    graph.add_nodes_from(files)
    for module, path in files.items():
        package = module if path.name == "__init__.py" else module.rpartition(".")[0]
        for name in imported_names(ast.parse(path.read_text(encoding="utf-8")), package):
            known = name if name in files else name.rpartition(".")[0]
            if known in files and known != module:
                graph.add_edge(module, known)
    for contract in contracts():
        for exception in contract.get("ignore_imports", []):
            source, target = (pattern.strip() for pattern in exception.split("->"))
            matching = [e for e in graph.edges if fnmatchcase(e[0], source) and fnmatchcase(e[1], target)]
            graph.remove_edges_from(matching)
    return graph


def imported_names(tree: ast.Module, package: str) -> Iterator[str]:
    """The names that a file imports, at the top or inside functions; `from a import b` gives a.b."""
    for node in ast.walk(tree):
        if isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            source = resolve_name("." * node.level + (node.module or ""), package)
            yield from (f"{source}.{alias.name}" for alias in node.names)


def contracts(kind: str | None = None) -> list[dict[str, Any]]:
    """The contracts of import-linter in pyproject.toml, all or those of one kind."""
    settings = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["tool"]["importlinter"]
    return [contract for contract in settings["contracts"] if kind in (None, contract["type"])]


def layers(container: str) -> list[list[str]]:
    """The layers of a package, highest first, each a list of names in the package that exist."""
    (contract,) = [c for c in contracts("layers") if c["containers"] == [container]]
    files = source_files()
    found = []
    for layer in contract["layers"]:
        names = layer.replace("|", ":").split(":")
        found.append([name for name in (n.strip(" ()\n") for n in names) if f"{container}.{name}" in files])
    return [layer for layer in found if layer]


def upward_imports(graph: nx.DiGraph, container: str) -> list[str]:
    """The imports from a lower layer of a package to a higher one, as "importer -> imported"."""
    height = {name: -index for index, layer in enumerate(layers(container)) for name in layer}
    return [
        f"{importer} -> {imported}"
        for importer, imported in graph.edges
        if _height(importer, container, height) < _height(imported, container, height)
    ]


def _height(module: str, container: str, height: Mapping[str, int]) -> float:
    """NaN, which is neither below nor above anything, for a module outside of the layers."""
    return height.get(_member(module, container), float("nan"))


def _member(module: str, container: str) -> str:
    """Which name directly in a package a module belongs to; "" for none."""
    inside = module.removeprefix(f"{container}.")
    return "" if inside == module else inside.partition(".")[0]


def circles(graph: nx.DiGraph) -> list[list[str]]:
    """The groups of modules that import each other in a circle."""
    return [sorted(group) for group in nx.strongly_connected_components(graph) if len(group) > 1]


# The drawing: a line for each module or package of the engine, layers in bands of alternating color, the operators'
# layers above them. On the left, an arc down from whoever imports to what it imports, unless a longer way says so too.

_LINE = 20
_MARGIN = 14
_ARCS = 190
_NAMES = 130
_WIDTH = 1000
_BANDS = ("#eef3f8", "#e0e9f2")
_NODES_BANDS = ("#f7f0e6", "#f1e5d3")
_PER_LINE = 100


def drawing() -> str:
    """The layers of nodes/ and graphface/ as the text of an SVG."""
    graph = import_graph()
    y = _MARGIN
    parts: list[str] = [_heading(y, "nodes/", "the operators")]
    for index, layer in enumerate(layers("graphface.nodes")):
        lines = _wrapped(layer)
        y = _band(parts, y, _NODES_BANDS[index % 2], [("", line) for line in lines])
    y += _LINE // 2
    parts.append(_heading(y, "graphface/", "the engine"))
    centers = {}
    files = source_files()
    for index, layer in enumerate(layers("graphface")):
        members = [name for name in _top_down(graph, layer) if name not in ("nodes", "graphs")]
        for row, name in enumerate(members):
            centers[name] = y + row * _LINE + _LINE / 2
        y = _band(parts, y, _BANDS[index % 2], [(name, _summary(files[f"graphface.{name}"])) for name in members])
    parts += [_arc(centers[a], centers[b], f"{a} imports {b}") for a, b in _direct_edges(graph, centers)]
    head = (
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{_WIDTH}" height="{y + _MARGIN}" '
        f'viewBox="0 0 {_WIDTH} {y + _MARGIN}" font-family="sans-serif" font-size="12">'
    )
    return "\n".join([head, f'<rect width="{_WIDTH}" height="{y + _MARGIN}" fill="white"/>', *parts, "</svg>", ""])


def _top_down(graph: nx.DiGraph, layer: list[str]) -> list[str]:
    """The members of one layer, whoever imports above what it imports."""
    inside = nx.DiGraph()
    inside.add_nodes_from(layer)
    pairs = ((_member(a, "graphface"), _member(b, "graphface")) for a, b in graph.edges)
    inside.add_edges_from((a, b) for a, b in pairs if a in layer and b in layer and a != b)
    return list(nx.lexicographical_topological_sort(inside, key=layer.index))


def _direct_edges(graph: nx.DiGraph, members: Mapping[str, float]) -> list[tuple[str, str]]:
    """The imports between members of the engine, without those that follow from others."""
    between = nx.DiGraph()
    for importer, imported in graph.edges:
        a, b = _member(importer, "graphface"), _member(imported, "graphface")
        if a in members and b in members and a != b:
            between.add_edge(a, b)
    return sorted(nx.transitive_reduction(between).edges)


def _wrapped(names: list[str]) -> list[str]:
    """Names set one beside the other in as few lines as they need."""
    lines = [names[0]]
    for name in names[1:]:
        if len(lines[-1]) + len(name) < _PER_LINE:
            lines[-1] += f"  {name}"
        else:
            lines.append(name)
    return lines


def _summary(path: Path) -> str:
    """The first sentence of a module's docstring, as much of it as fits."""
    text = " ".join((ast.get_docstring(ast.parse(path.read_text(encoding="utf-8"))) or "").split("\n\n")[0].split())
    return text if len(text) <= _PER_LINE else f"{text[: text.rindex(' ', 0, _PER_LINE)]} …"


def _band(parts: list[str], top: float, color: str, rows: list[tuple[str, str]]) -> int:
    """Draw a layer; returns where the next one begins."""
    height = len(rows) * _LINE
    parts.append(f'<rect x="{_ARCS}" y="{top}" width="{_WIDTH - _ARCS - _MARGIN}" height="{height}" fill="{color}"/>')
    for row, (name, text) in enumerate(rows):
        y = top + row * _LINE + 14
        parts.append(f'<text x="{_ARCS + 8}" y="{y}" font-weight="bold">{escape(name)}</text>')
        parts.append(f'<text x="{_ARCS + (_NAMES if name else 8)}" y="{y}">{escape(text)}</text>')
    return int(top + height)


def _heading(top: float, *lines: str) -> str:
    """Words to the left of a block of layers."""
    return "\n".join(f'<text x="{_MARGIN}" y="{top + 14 + row * 16}">{line}</text>' for row, line in enumerate(lines))


def _arc(above: float, below: float, title: str) -> str:
    """A line bent to the left from who imports down to what is imported, with a dot at its lower end."""
    reach = _ARCS - 6 - min(_ARCS - _MARGIN, 8 + 0.45 * (below - above))
    path = f"M{_ARCS - 4} {above + 3} C{reach:.0f} {above + 3} {reach:.0f} {below - 3} {_ARCS - 4} {below - 3}"
    return (
        f'<g fill="none" stroke="#4a6785"><title>{escape(title)}</title><path d="{path}"/>'
        f'<circle cx="{_ARCS - 4}" cy="{below - 3}" r="2" fill="#4a6785"/></g>'
    )


if __name__ == "__main__":
    DRAWING.write_text(drawing(), encoding="utf-8")
    print(f"wrote {DRAWING.relative_to(ROOT)}")
