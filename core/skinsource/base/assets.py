"""Folders of the library's own data and of the user's data."""

import os
from pathlib import Path

import platformdirs

PACKAGE = Path(__file__).resolve().parents[1]


def data_folder() -> Path:
    """Return the folder of the library's data: ``skinsource/_data`` in a wheel, else ``data``."""
    installed = PACKAGE / "_data"
    return installed if installed.is_dir() else PACKAGE.parents[1] / "data"


def manual_file() -> Path:
    """Return the first page of the manual: the site, if a wheel has it, else README.md."""
    installed = PACKAGE / "_manual"
    site = installed / "index.html"
    if site.is_file():
        return site
    return (installed if installed.is_dir() else PACKAGE.parents[1]) / "README.md"


def user_folder() -> Path:
    """Return the folder of the user's data; the variable SKINSOURCE_DATA overrides it."""
    usual = platformdirs.user_data_dir("skinsource", appauthor=False)
    return Path(os.environ.get("SKINSOURCE_DATA") or usual).expanduser()


def cache_folder() -> Path:
    """Return the folder of the cache; SKINSOURCE_CACHE overrides it, and SKINSOURCE_DATA."""
    return _folder("cache", platformdirs.user_cache_dir("skinsource", appauthor=False))


def config_folder() -> Path:
    """Return the folder of the settings; SKINSOURCE_CONFIG overrides it, and SKINSOURCE_DATA."""
    return _folder("config", platformdirs.user_config_dir("skinsource", appauthor=False))


def _folder(name: str, usual: str) -> Path:
    override = os.environ.get(f"SKINSOURCE_{name.upper()}")
    if override:
        return Path(override).expanduser()
    return user_folder() / name if os.environ.get("SKINSOURCE_DATA") else Path(usual)
