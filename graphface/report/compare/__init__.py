"""The viewer that pages share: pictures side by side, in turn, under a wipe, as their difference; zoom in step.

`viewer.js` and `viewer.css` are the viewer, `embed` puts them and the pictures into a page that needs nothing else,
`mask` says which pixels differ.
"""
