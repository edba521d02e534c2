"""Drawings of a graph: a layered layout with frames for nested graphs, as SVG, PNG, HTML, Mermaid and DOT."""
