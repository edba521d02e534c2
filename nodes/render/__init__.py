"""New light on a face: where it is shaded, what it receives, shadows, highlights, what lies beyond the face."""
