"""Meshes and textures for other programs: `textured`."""
