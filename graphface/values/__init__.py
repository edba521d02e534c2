"""Values that travel along wires: types, made immutable, known by content, stored, written to files."""
