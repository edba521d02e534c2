"""A mesh drawn into the picture (`rasterize`), face coordinates of pixels (`coordinates`) and visibility of vertices
(`visibility`)."""
