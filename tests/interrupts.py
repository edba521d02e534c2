"""Programs that hear Ctrl-C however the tests were started."""

HEARD = "import signal; signal.signal(signal.SIGINT, signal.default_int_handler)"
"""Python that a child process runs first. A shell starts what it runs in the background, the tests perhaps, with SIGINT
ignored, and a child inherits that."""
