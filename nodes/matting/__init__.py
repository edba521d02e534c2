"""The soft edge between face, hair and background: four ways, from free to exact.

- `none`: the labels as they are;
- `guided`: the photo's edges lent to the labels by a guided filter, in milliseconds;
- `closed_form`: the matting Laplacian of the paper, solved where the label is unknown;
- `knn`: the same solve, with the likest pixels in place of the nearest.

`band` says where the label is unknown, `solve` finds the alphas there (`laplacian` and `coarse` are the system of
`closed_form` and its solutions from afar, `two_level` makes the search short). Operators take the photo, soft labels
and landmarks (for lengths), and give labels that sum to 1.
"""
