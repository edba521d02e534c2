"""What a surface in the picture is good for: correspondence, textures, visibility, export."""
