"""The soft edge between face, hair and background: four methods, from free to exact.

- `none`: the labels as they are;
- `guided`: a guided filter aligns the labels with the photo's edges, in milliseconds;
- `closed_form`: the matting Laplacian of the paper, solved in a band along the edges;
- `knn`: the same solve, with the most similar pixels in place of the nearest.

`band` is the area where alphas are unknown, `solve` finds them by conjugate gradients, preconditioned by `two_level`.
`laplacian` and `coarse` are the system of `closed_form` and a basis of its smooth solutions. Operators take the photo,
soft labels and landmarks (for lengths), and give labels that sum to 1.
"""
