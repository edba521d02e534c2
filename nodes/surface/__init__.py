"""A mesh drawn into the picture (`rasterize`), and what it says of pixels (`coordinates`) and vertices
(`visibility`)."""
