"""Lights from elsewhere: of another photograph (`scene`), of a panorama (`panorama`)."""
