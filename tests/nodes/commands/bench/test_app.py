"""`graphface bench`: what it lists, and what it costs those who do not ask for it."""

from __future__ import annotations

import subprocess
import sys
from importlib import import_module

import pytest

from graphface.nodes.commands.bench import COMMANDS


class TestApp:
    def test_lists_every_command(self, command):
        """By name, with the first sentence of what it measures."""
        said = command("bench", "--help")
        assert said.code == 0
        for name in COMMANDS:
            assert name in said.out

    @pytest.mark.parametrize("name", COMMANDS)
    def test_says_what_it_measures(self, command, name):
        """On which data, and what it prints."""
        said = command("bench", name, "--help")
        assert said.code == 0
        assert import_module(f"graphface.nodes.commands.bench.{name}").__doc__.startswith(f"`graphface bench {name}`")
        assert "Data:" in said.out
        assert "Prints" in said.out

    def test_a_typing_error(self, command):
        """The nearest command is told."""
        said = command("bench", "ligths")
        assert said.code == 2
        assert "'lights'" in said.err

    def test_help_of_the_program_imports_no_bench(self):
        """Neither measuring nor training, nor an array library."""
        program = (
            "import sys; from graphface.cli import main\n"
            "try: main(['--help'])\n"
            "except SystemExit: pass\n"
            "print([m for m in sys.modules if m.startswith(('graphface.nodes.bench', 'graphface.nodes.learning',"
            " 'graphface.nodes.commands.bench.')) or m in ('numpy', 'cv2')])"
        )
        done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True)
        assert done.stdout.splitlines()[-1] == "[]"
