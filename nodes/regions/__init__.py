"""The regions of a face, `nine` of detail transfer, and the `features` that makeup leaves alone; both from one
`atlas`."""
