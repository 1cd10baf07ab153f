"""``rrnn``: finds the command, runs it, and turns every end into an exit status.

0 all that was asked holds; 1 something asked does not hold; 2 bad input;
130 interrupted by Ctrl-C, 143 by SIGTERM.  Commands are imported here, what
they need only when they run: ``rrnn --help`` loads no numerical library.
"""

from __future__ import annotations

import argparse
import contextlib
import io
import sys
from collections.abc import Sequence
from typing import Any, NoReturn

from rrnn_opt.cli import (
    check,
    compare,
    demo,
    doctor,
    generate,
    plan,
    reproduce,
    robots,
    simulate,
    spheres,
    verify,
    view,
)
from rrnn_opt.cli.folders import FULL, os_sentence
from rrnn_opt.cli.interrupt import Interrupt, noticed
from rrnn_opt.cli.named import unknown
from rrnn_opt.cli.output import Output, UsageError, opened
from rrnn_opt.errors import RrnnError

COMMANDS: dict[str, Any] = {
    "demo": demo,
    "plan": plan,
    "check": check,
    "view": view,
    "simulate": simulate,
    "generate": generate,
    "verify": verify,
    "compare": compare,
    "reproduce": reproduce,
    "spheres": spheres,
    "robots": robots,
    "doctor": doctor,
}
FAILED, BAD_INPUT, INTERRUPTED = 1, 2, 130


class _Help(argparse.HelpFormatter):
    """Help with room for the longest command: argparse forgets its indentation."""

    def __init__(self, prog: str) -> None:
        super().__init__(prog)
        self._action_max_length = max(map(len, COMMANDS)) + 4


class _Parser(argparse.ArgumentParser):
    """A parser that raises instead of leaving and wants options in full."""

    def __init__(self, **options: Any) -> None:
        super().__init__(allow_abbrev=False, **options)

    def error(self, message: str) -> NoReturn:
        raise UsageError(f"{message} (see {self.prog} --help)")


def parser() -> argparse.ArgumentParser:
    """The parser of all commands."""
    top = _Parser(
        prog="rrnn",
        description="One symbolic law in; a proof, a solver, a plan and a controller"
        " out.",
        formatter_class=_Help,
    )
    top.add_argument("--version", action="version", version=_version())
    commands = top.add_subparsers(dest="command", metavar="COMMAND", required=True)
    for name, module in COMMANDS.items():
        command = commands.add_parser(name, help=module.HELP, description=module.HELP)
        module.add_arguments(command)
        command.add_argument(
            "--json", action="store_true", help="print one JSON document"
        )
        command.add_argument(
            "--debug", action="store_true", help="show the traceback of an error"
        )
    return top


def parsed(words: Sequence[str]) -> argparse.Namespace:
    """Arguments of the command that the words name.

    Raises:
        UsageError: there is no such command, or it has no such argument.
    """
    first = next((word for word in words if not word.startswith("-")), None)
    if first is not None and first not in COMMANDS:
        raise UsageError(f"{unknown('command', first, COMMANDS)} (see rrnn --help)")
    args, rest = parser().parse_known_args(words)
    if rest:
        told = f"unrecognized arguments: {' '.join(rest)}"
        raise UsageError(f"{told} (see rrnn {args.command} --help)")
    return args


def main(argv: Sequence[str] | None = None) -> int:
    """Run one command.

    Args:
        argv: arguments after the program's name; the process's by default.

    Returns:
        The exit status.
    """
    words = list(sys.argv[1:] if argv is None else argv)
    name = next((word for word in words if word in COMMANDS), "")
    with opened("--json" in words) as out, noticed() as interrupt:
        code = _guarded(words, name, out, interrupt)
        if not interrupt.seen:
            return code
        if code not in (interrupt.status, INTERRUPTED):  # it came at the end
            out.note(f"rrnn: {interrupt.sentence}; the command had come to its end")
        return interrupt.status


def _guarded(words: list[str], name: str, out: Output, interrupt: Interrupt) -> int:
    try:
        return _run(words, out)
    except KeyboardInterrupt:
        return _failed(out, name, interrupt.sentence, interrupt.status)
    except Exception as error:
        if interrupt.seen:
            return _failed(out, name, interrupt.sentence, interrupt.status)
        if "--debug" in words:
            raise
        return _explained(out, name, error)


def _run(words: list[str], out: Output) -> int:
    """Run the command; what ``--help`` and ``--version`` show is a result too."""
    shown = io.StringIO()
    try:
        with contextlib.redirect_stdout(shown):
            args = parsed(words)
    except SystemExit:
        out.document({"text": shown.getvalue()})
        out.say(shown.getvalue().rstrip())
        return 0
    code = int(COMMANDS[args.command].run(args, out))
    _mention_cache(out)
    return code


def _mention_cache(out: Output) -> None:
    """Say when compiled code could not be kept, for that costs time at every run."""
    cache = sys.modules.get("rrnn_opt.emit.cache")
    if cache is not None and cache.private_folder.cache_info().currsize:
        out.note(
            f"rrnn: compiled code cannot be kept in {cache.cache_folder()}, so that it"
            " is compiled again every time; set RRNN_CACHE_DIR to a folder with room"
        )


def _explained(out: Output, name: str, error: Exception) -> int:
    """One sentence on an error, and whose fault it is."""
    cause = error if isinstance(error, OSError) else error.__cause__
    full = isinstance(cause, OSError) and cause.errno in FULL
    if isinstance(error, RrnnError):
        return _failed(out, name, str(error), FAILED if full else BAD_INPUT)
    if isinstance(error, OSError):
        code = FAILED if out.done or full else BAD_INPUT
        return _failed(out, name, os_sentence(error), code)
    hint = "this is a fault of ours: run it again with --debug to see where"
    return _failed(out, "", f"{type(error).__name__}: {error}; {hint}", FAILED)


def _failed(out: Output, name: str, text: str, code: int) -> int:
    """Say what went wrong; with ``--json`` also as a document."""
    sentence = " ".join(text.split())
    out.note(f"rrnn: {sentence}")
    kind = {FAILED: "failed", BAD_INPUT: "bad_input"}.get(code, "interrupted")
    describe = getattr(COMMANDS.get(name), "failure", None)
    if describe is not None:
        out.document(describe(kind, sentence))
    else:
        out.document({"error": {"kind": kind, "message": sentence}})
    return code


def _version() -> str:
    from importlib import metadata

    return f"rrnn_opt {metadata.version('rrnn_opt')}"


if __name__ == "__main__":
    sys.exit(main())
