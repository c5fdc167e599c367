"""What goes wrong, as exceptions and warnings."""

from __future__ import annotations


class TemperError(ValueError):
    """Bad input, or an option that makes no sense: what C++ returns as ``InputError``.

    Attributes
    ----------
    code : str
        The kind of error, stable across versions: ``"duplicate_point"``, ``"not_finite"``, … (``temper::ErrorCode``).
    where : str
        The place in the file, ``"coast.msh:41"``; empty when the input came as arrays.
    message : str
        What is wrong: element, expected, found. In the file's own numbering for what was read from a file, else
        counted from 0.
    """

    def __init__(self, code: str, where: str, message: str) -> None:
        self.code = code
        self.where = where
        self.message = message
        super().__init__(f"{where}: {message}" if where else message)

    def __reduce__(self) -> tuple[type[TemperError], tuple[str, str, str]]:
        return TemperError, (self.code, self.where, self.message)


class TemperWarning(UserWarning):
    """What was repaired or dropped in reading or writing, in one sentence."""
