"""Optional packages: the extras of the project."""

import importlib
import importlib.util
import platform
import sys
from pathlib import Path
from types import ModuleType

from skinsource.base.errors import MissingExtraError, printable, quoted


def in_folder() -> bool:
    """Whether this is the self-contained folder."""
    return getattr(sys, "frozen", False)


def extra_cure(extra: str) -> str:
    """Return the sentence that says how to get an extra that is missing."""
    if in_folder():
        return (
            "This folder takes no further packages; docs/installing.html says how to install "
            "SkinSource with them."
        )
    return f"Install it with: {extra_line(extra)}"


def extra_line(extra: str) -> str:
    """Return the line to type to install an extra, for a checkout or an installed package."""
    checkout = Path(__file__).resolve().parents[3]
    requirement = f'"skinsource[{extra}]"'
    if (checkout / "pyproject.toml").is_file():
        requirement = f'-e "{checkout}[{extra}]"'
    compiler = ""
    if extra == "dataset" and (sys.platform, platform.machine()) == ("darwin", "x86_64"):
        # mat-io has no wheel there, so that the extra leaves it out.
        compiler = "xcode-select --install, and when that has ended: "
        requirement = f"{requirement} mat-io"
    python = f'"{sys.executable}"' if " " in sys.executable else sys.executable
    if importlib.util.find_spec("pip") is None:
        # uv has made the environment.
        return f"{compiler}uv pip install --python {python} {requirement}"
    return f"{compiler}{python} -m pip install {requirement}"


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
            f"{extra_cure(extra)}"
        ) from error
