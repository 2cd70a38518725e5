"""The exit codes of the program as exceptions, with the messages that the program prints."""

from __future__ import annotations

from typing import Any, NoReturn


class Error(Exception):
    """The base class of all errors of this package except Interrupted.

    exit_code: the program's exit code for this error (sim/exit-codes.md).
    details: what the program prints about the error with --json, or None.
    """

    exit_code = 0
    details: dict[str, Any] | None = None


class WrongUsage(Error, ValueError):
    """An argument has no meaning. The program calls this a wrong command line."""

    exit_code = 2


class WrongInput(Error, ValueError):
    """A file or a text is wrong. The message begins with its place, file:line:column."""

    exit_code = 3


class EnvironmentLacks(Error, OSError):
    """The environment lacks something, for example a renderer or room on the disk."""

    exit_code = 4


class NoPlan(Error):
    """It is proved that there is no plan, no labeling or no plan tree."""

    exit_code = 10


class NoAnswer(Error):
    """There is no answer. The budget was spent, or the planner met a limit, which it names."""

    exit_code = 11


class Failed(Error):
    """A check was violated, or a trial failed."""

    exit_code = 12


class Interrupted(KeyboardInterrupt):
    """Ctrl-C ended a call, and the results that the call had by then are kept.

    result: a Run, TreeRun, Falsification or SweepDatabase with the finished trials or attempts. If
        the exception was not caught, as in a notebook, it is in `sys.last_value.result`.
    """

    def __init__(self, what: str, result: Any) -> None:
        super().__init__(f"{what}; they are in `result` of this exception (sys.last_value.result)")
        self.result = result


_ERRORS = (WrongUsage, WrongInput, EnvironmentLacks, NoPlan, NoAnswer, Failed)
_BY_CODE = {error.exit_code: error for error in _ERRORS}


def _raise(code: int, text: str, details: dict[str, Any] | None = None) -> NoReturn:
    error = _BY_CODE[code](text.rstrip("\n"))
    error.details = details
    raise error
