"""The one place that knows where the window's resources lie."""

from pathlib import Path

_PACKAGE = Path(__file__).resolve().parents[1]


def resource_folder() -> Path:
    """Folder of icons and themes: in the wheel ``skinsource_gui/_resources``, else the checkout."""
    installed = _PACKAGE / "_resources"
    return installed if installed.is_dir() else _PACKAGE.parent / "resources"


def read_text(name: str) -> str:
    """Content of a text resource."""
    return (resource_folder() / name).read_text(encoding="utf-8")
