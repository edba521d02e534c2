"""The family `intrinsic.*`: one photo in, albedo and shading out. One file per method, none calls another.

Every method keeps albedo * shading = photo: what differs is where a dark patch goes. All but `intensity` decide in the
logarithm of the intensity, where the product is a sum (`logarithm`), and leave the overall scale, which no photo tells,
such that shading has the mean of the intensity.
"""
