"""Packages that only some need: the extras of the project."""

import importlib
from types import ModuleType

from skinsource.errors import MissingExtraError
from skinsource.quoting import printable, quoted


def package_of_extra(name: str, extra: str) -> ModuleType:
    """Import a package, or a module of it, that comes with an extra.

    Raises
    ------
    MissingExtraError
        It is not installed, or cannot be imported; the message holds the line to type.
    """
    try:
        return importlib.import_module(name)
    except ImportError as error:
        raise MissingExtraError(
            f"the package {quoted(name)} is needed for this and cannot be imported "
            f"({printable(error)}). "
            f'Install it with: pip install "skinsource[{extra}]"'
        ) from error
