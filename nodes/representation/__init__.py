"""The whole representation of a face as one value: `bundle` makes it, `given` takes one from a file."""
