"""From a reference photo to the input: where each pixel's point of the face is there, and values fetched from there."""
