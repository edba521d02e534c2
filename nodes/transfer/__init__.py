"""Detail transfer between two faces in nine regions; the input's light and albedo stay (paper, "Face Detail Transfer").

`mask` says which pixels take the reference's detail, and `paint` which of them show makeup and do not; `recolored`
adapts the reference's detail map to the input's albedo; `detail` exchanges a band of the input's map.
"""
