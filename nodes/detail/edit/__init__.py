"""Edits of a finished detail map: by frequency (`bands`), of dark lines (`wrinkles`), of bright patches (`shine`)."""
