"""A face's geometry from its landmarks: `facemesh` takes the network's depth, `morphable` fits a face model,
`average` its mean."""
