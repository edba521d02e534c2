"""Light from other sources than a scene file: another photograph (`scene`), a panorama (`panorama`)."""
