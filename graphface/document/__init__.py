"""Graph files: YAML with positions (`located`), read (`document`) and composed (`compose`) to one flat graph."""
