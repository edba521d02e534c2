"""Intrinsic images: the methods `intrinsic.*` split one photo into albedo and shading; one file per method.

Every method keeps albedo * shading = photo. They differ in whether a dark patch is albedo or shading. All but
`intensity` decide in the logarithmic domain, where the product is a sum (`log_domain`). A photo does not determine the
overall scale of the shading; they choose it such that shading has the mean of the intensity.
"""
