"""The nine regions of a face between which detail is transferred: `nine` projects them from the `atlas`."""
