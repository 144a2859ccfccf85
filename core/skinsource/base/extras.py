"""Optional packages: the extras of the project."""

import importlib
import sys
from pathlib import Path
from types import ModuleType

from skinsource.base.errors import MissingExtraError, printable, quoted


def extra_line(extra: str) -> str:
    """Return the line to type to install an extra, for a checkout or an installed package."""
    checkout = Path(__file__).resolve().parents[3]
    requirement = f'"skinsource[{extra}]"'
    if (checkout / "pyproject.toml").is_file():
        requirement = f'-e "{checkout}[{extra}]"'
    python = f'"{sys.executable}"' if " " in sys.executable else sys.executable
    return f"{python} -m pip install {requirement}"


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
            f"Install it with: {extra_line(extra)}"
        ) from error
