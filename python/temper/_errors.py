"""Errors and warnings, as Python classes."""

from __future__ import annotations


class TemperError(ValueError):
    """Bad input, or an option that makes no sense. C++ returns it as ``InputError``.

    Attributes
    ----------
    code : str
        The kind of error, stable across versions: ``"duplicate_point"``, ``"not_finite"``, … (``temper::ErrorCode``).
    where : str
        The place in the file, such as ``"coast.msh:41"``; empty if the input was arrays.
    message : str
        The message: element, expected and found value. Elements have the file's own numbering, or count from 0 for
        arrays.
    """

    def __init__(self, code: str, where: str, message: str) -> None:
        self.code = code
        self.where = where
        self.message = message
        super().__init__(f"{where}: {message}" if where else message)

    def __reduce__(self) -> tuple[type[TemperError], tuple[str, str, str]]:
        return TemperError, (self.code, self.where, self.message)


class TemperWarning(UserWarning):
    """A repair or a loss in reading or writing, in one sentence."""
