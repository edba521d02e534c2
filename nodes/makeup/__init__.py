"""Makeup transfer (paper, section "Makeup Transfer"), one stage per file, in the order in which the graph runs them.

`features` draws masks of eyes, lips, nose and other parts, `closed_mouth` takes lips that touch for closed. `skin` is
what may be painted, `loose_hair` and `beard` remove hair from it, `occluders` finds glasses and lashes, and `core`
joins them all. `bare_skin` is a face with even skin that wears nothing; `paint` what departs from it, as a layer of
opacity and pigment; `foundation` shifts skin within a bound, and `layer` puts the paint over it: the face keeps its own
skin and brows.

The paper's method moves the whole albedo. `pigment` takes creases and shine out of it. `albedo` and `shading` put the
reference's paint under the input's light, `detail` blends the detail maps by the shares of `keep`, `boundary` continues
the painted face to neck, ears and hairline. `coverage` says how strongly each pixel is made up, in both.
"""
