"""Operators on pictures: change of encoding (`encode`) and of size (`resize`), reconstruction of clipped highlights
(`unclipped`)."""
