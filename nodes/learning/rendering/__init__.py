"""Path-traced heads with everything known, to learn from: `graphface models render`.

- `head_model` reads ICT-FaceKit's whole head; `noise`, `relief` and `skin` make one person of it;
- `lights` and `film` choose how the picture is lit and taken, `scene` renders it with mitsuba;
- `picture` makes one, `example` is it with its truth and its file, `folder` fills a folder.
"""
