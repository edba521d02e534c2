"""Edits of a detail map once it is made: by frequency `bands`, of `wrinkles`, of `shine`."""
