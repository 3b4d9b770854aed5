"""The commands of the program. Each is imported when it is called, so help is shown at once."""

from __future__ import annotations

from importlib import import_module

import click

#: The commands, each in the module of its name, with its line in the program's help.
COMMANDS = {
    "animate": "Solve a timeline and write its frames.",
    "blend": "Blend poses and write the shapes.",
    "build": "Make a model from a problem.",
    "check": "Say what is wrong with a surface or mesh, and mend it.",
    "demo": "Build and paint a model of a generated creature.",
    "export": "Write a model as one HTML page, as glTF, or for Blender.",
    "info": "Show what a file contains.",
    "interpolate": "Make a model that blends poses.",
    "pose": "Move handles and write the shape.",
    "validate": "Measure the error of a model.",
    "view": "Pose or blend in the browser, or choose handles there.",
}


class Commands(click.Group):
    """A group that knows the names of its commands without importing them."""

    def list_commands(self, ctx: click.Context) -> list[str]:
        """All names, in alphabetical order."""
        return sorted(COMMANDS)

    def get_command(self, ctx: click.Context, cmd_name: str) -> click.Command | None:
        """The command with this name, or None if there is none."""
        if cmd_name not in COMMANDS:
            return None
        command = getattr(import_module(f".{cmd_name}", __package__), cmd_name)
        assert isinstance(command, click.Command)
        return command

    def format_commands(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:
        """Writes the section of the help that lists the commands."""
        with formatter.section("Commands"):
            formatter.write_dl([(name, COMMANDS[name]) for name in self.list_commands(ctx)])
