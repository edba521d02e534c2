"""The kinds of files that are written, by their suffix."""

PICTURES = (".png", ".jpg", ".jpeg", ".webp", ".tif", ".tiff")
MESHES = (".obj", ".ply", ".glb", ".gltf")
