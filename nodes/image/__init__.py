"""Pictures: between encodings (`encode`), at another size (`resize`), with clipped highlights given back
(`unclipped`)."""
