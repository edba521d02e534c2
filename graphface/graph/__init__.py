"""The immutable graph: names looked up (`wiring`), keys known before a run (`keys`), and a request of it."""
