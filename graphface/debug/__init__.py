"""A run that stands still at a node: where it stops (`breakpoint`), what can be asked there (`prompt`), pdb inside."""
