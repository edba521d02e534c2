"""Detail transfer between two faces in nine regions; the input's light and albedo stay (paper, "Face Detail Transfer").

`skin` says where both photos show skin, and `mask` which pixels take how much. `bands` exchanges the relief of skin in
three bands, and `shine` adds shine or takes it off. The paper's way: `paint` says which pixels show makeup and stay,
`recolored` adapts the reference's detail map to the input's albedo, and `detail` exchanges a band of the input's map.
"""
