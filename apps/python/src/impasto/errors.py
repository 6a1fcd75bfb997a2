"""Errors, each with a hint, and findings as warnings."""

from __future__ import annotations

import re
import warnings
from collections.abc import Iterable
from dataclasses import dataclass

_PLACE = re.compile(
    r"^(?P<file>.+?), (?:row|line|cell [A-Z]+)[ ]?(?P<row>\d+)(?:, column `(?P<column>[^`]*)`)?"
)


@dataclass(frozen=True)
class Place:
    """Place of a fault in a file: row from 1 with the headings as row 1, and the heading of the column."""

    file: str
    row: int
    column: str | None = None


class Error(ValueError):
    """Something that impasto cannot do. `hint` says how to go on, if impasto knows a way."""

    def __init__(self, message: str, hint: str | None = None) -> None:
        super().__init__(message)
        self.message = message
        self.hint = hint

    def __str__(self) -> str:
        return self.message if self.hint is None else f"{self.message}\nhint: {self.hint}"

    def __reduce__(self) -> tuple[type[Error], tuple[str, str | None]]:
        return type(self), (self.message, self.hint)

    @property
    def place(self) -> Place | None:
        """File, row and column of the fault, where the message names a row."""
        found = _PLACE.match(self.message)
        return found and Place(found["file"], int(found["row"]), found["column"])


class ReadingError(Error):
    """Measurements that cannot be used."""


class RecipeError(Error):
    """Names, parts or targets that cannot be mixed or matched."""


class FitError(Error):
    """A fit, a validation or a plan that fails."""


class FileError(Error, OSError):
    """A file that cannot be read or written."""


class FindingWarning(UserWarning):
    """What a user should know about data or a result: a warning of the program `impasto`."""


def warn(findings: Iterable[str]) -> None:
    """Tells each finding as a `FindingWarning` of the caller outside this package."""
    for finding in findings:
        warnings.warn(finding, FindingWarning, stacklevel=3)


def warnings_of(remarks: Iterable[tuple[bool, str, str | None]]) -> list[str]:
    """The warnings among remarks, each with its hint."""
    return [text if hint is None else f"{text}; {hint}" for serious, text, hint in remarks if serious]


def notes_of(remarks: Iterable[tuple[bool, str, str | None]]) -> list[str]:
    """The notes among remarks, each with its hint."""
    return [text if hint is None else f"{text}; {hint}" for serious, text, hint in remarks if not serious]
