"""`unwrap` makes a texture of a photo's face, `project` draws a texture onto the face in a photo."""
