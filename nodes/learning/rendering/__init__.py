"""Path-traced heads with everything known, to learn from: `graphface models render`.

- `head_model` reads ICT-FaceKit's whole head; `noise`, `relief` and `skin` make one person of it;
- `lights` and `film` choose how the picture is lit and taken, `scene` renders it with mitsuba;
- `example` is one picture with its truth, `folder` fills a folder with them.
"""
