"""Packages that only those need who install the measured dataset."""

import importlib
from types import ModuleType

from skinsource.errors import MissingExtraError
from skinsource.quoting import printable, quoted


def optional_package(name: str) -> ModuleType:
    """Import a package of the extra ``dataset``.

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
            'Install it with: pip install "skinsource[dataset]"'
        ) from error
