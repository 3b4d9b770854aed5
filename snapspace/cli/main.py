"""The program `snapspace`: its commands, and how it reports errors."""

from __future__ import annotations

import os
import sys
import warnings
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from typing import Any

import click

from ..notice import Notice
from ..stopping import ctrl_c_as_itself
from .commands import Commands
from .console import notice, one_line
from .fault_log import fault_line
from .termination import terminated_as_interrupted

OK, FAULT, USER_ERROR, INTERRUPTED, BROKEN_PIPE, TERMINATED = 0, 1, 2, 130, 141, 143


@click.group(
    cls=Commands,
    invoke_without_command=True,
    context_settings={"help_option_names": ["-h", "--help"], "max_content_width": 100},
)
@click.version_option(
    package_name="snapspace", prog_name="snapspace", message="%(prog)s %(version)s"
)
@click.pass_context
def snapspace(ctx: click.Context) -> None:
    """Pose elastic meshes live: sample a shape problem, keep the best small space, solve in it.

    \b
    Try it:
      snapspace demo                                     # a creature, ready to pose
    With a mesh of your own:
      snapspace build --problem dragon.json -o dragon.snapspace
      snapspace validate dragon.snapspace
      snapspace pose dragon.snapspace --handle head --euler 0,0,30 -o posed.obj
      snapspace view dragon.snapspace                  # in the browser
      snapspace export dragon.snapspace --html dragon.html
      snapspace check dragon.obj                       # is it ready to be filled?
    With poses of your own:
      snapspace interpolate stand.obj sit.obj run.obj -o cat.snapspace
      snapspace blend cat.snapspace --path 60 -o frames

    With --json a command prints one JSON object on standard output; everything else goes to
    standard error. Exit codes: 0 done, 1 a bug in snapspace, or a fault that `check` found, 2 a
    mistake in the input, 130 interrupted (Ctrl-C), 143 terminated (SIGTERM). After the last two,
    finished work is kept.
    """
    if ctx.invoked_subcommand is None:
        click.echo(ctx.get_help())


def main(arguments: Sequence[str] | None = None) -> int:
    """Runs the program and returns its exit code.

    Mistakes of the user (ValueError from the library, wrong usage) become one line on standard
    error. Anything else is a bug in Snapspace: it also becomes one line, which names a file with
    the traceback. SIGTERM ends commands as Ctrl-C does.
    """
    words = list(sys.argv[1:] if arguments is None else arguments)
    with terminated_as_interrupted() as termination:
        try:
            return _run(words)
        except (KeyboardInterrupt, click.Abort) as stop:
            what = "terminated" if termination.came else "interrupted"
            notice(f"{what}{': ' if str(stop) else ''}{stop}")
            return TERMINATED if termination.came else INTERRUPTED


def _run(words: list[str]) -> int:
    try:
        with ctrl_c_as_itself(), _notices(), snapspace.make_context("snapspace", words) as ctx:
            snapspace.invoke(ctx)
        sys.stdout.flush()
    except click.exceptions.Exit as stop:
        return stop.exit_code
    except click.ClickException as error:
        return _refuse(_usage(error))
    except ValueError as error:
        return _refuse(str(error))
    except MemoryError as error:
        return _refuse(f"not enough memory ({error}); use fewer samples or a smaller dimension")
    except click.Abort:
        raise
    except BrokenPipeError:
        # the pipe's reader is gone; Python would report that again when it closes the pipe
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return BROKEN_PIPE
    except Exception as error:
        notice(fault_line(error, words))
        return FAULT
    return OK


def _refuse(message: str) -> int:
    notice(f"error: {message}")
    return USER_ERROR


def _usage(error: click.ClickException) -> str:
    message = one_line(error.format_message()).rstrip(".")
    ctx = getattr(error, "ctx", None)
    return f"{message}; see '{ctx.command_path} --help'" if ctx else message


@contextmanager
def _notices() -> Iterator[None]:
    """Shows each `Notice` as one line, and the same text once.

    A surface may be mended twice, for quick tets and then for fTetWild.
    """
    shown: set[str] = set()
    with warnings.catch_warnings():
        warnings.simplefilter("always", Notice)
        ordinary = warnings.showwarning

        def show(message: Warning | str, category: type[Warning], *where: Any, **to: Any) -> None:
            if not issubclass(category, Notice):
                ordinary(message, category, *where, **to)
            elif str(message) not in shown:
                shown.add(str(message))
                notice(f"notice: {message}")

        warnings.showwarning = show
        yield
