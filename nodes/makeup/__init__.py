"""Makeup transfer (paper, section "Makeup Transfer"), a stage a file, in the order in which the graph runs them.

`features` where eyes, lips, nose ... are; `albedo` and `shading` the reference's paint under the input's light;
`detail` the blended detail map; `skin` and `coverage` where paint may go and how strongly, `loose_hair` what of it no
strand of hair hides, `beard` what of it is no beard; `boundary` the way from the painted face to neck, ears and
hairline.
"""
