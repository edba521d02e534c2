"""From a reference photo to the input: `mesh` finds where each pixel's point of the face lies in the reference, and
`resample` computes the reference's values there."""
