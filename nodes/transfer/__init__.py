"""Detail transfer between regions of two faces, the input's light and albedo kept (paper, "Face Detail Transfer")."""
