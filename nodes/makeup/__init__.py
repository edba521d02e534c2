"""Makeup transfer (paper, section "Makeup Transfer"), one stage per file, in the order in which the graph runs them.

`features` draws masks of eyes, lips, nose and other parts. `skin` is what may be painted, `loose_hair` and `beard`
remove hair from it, `occluders` finds glasses and lashes, and `core` joins them all. `pigment` takes creases and shine
out of the albedo. `albedo` and `shading` put the reference's paint under the input's light, `detail` blends the detail
maps by the shares of `keep`, `boundary` continues the painted face to neck, ears and hairline, and `coverage` says how
strongly each pixel is made up.
"""
