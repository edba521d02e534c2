"""The whole representation of a face as one value: `bundle` makes it of its parts, `given` passes on a saved one."""
