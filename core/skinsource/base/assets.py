"""Folders of the library's own data and of the user's data."""

import os
from pathlib import Path

import platformdirs

PACKAGE = Path(__file__).resolve().parents[1]


def data_folder() -> Path:
    """Return the folder of the library's data: ``skinsource/_data`` in a wheel, else ``data``."""
    installed = PACKAGE / "_data"
    return installed if installed.is_dir() else PACKAGE.parents[1] / "data"


def user_folder() -> Path:
    """Return the folder of the user's data; the variable SKINSOURCE_DATA overrides it."""
    override = os.environ.get("SKINSOURCE_DATA")
    if override:
        return Path(override).expanduser()
    return Path(platformdirs.user_data_dir("skinsource", appauthor=False))


def cache_folder() -> Path:
    """Return the folder of the cache; SKINSOURCE_CACHE overrides it, and SKINSOURCE_DATA."""
    override = os.environ.get("SKINSOURCE_CACHE")
    if override:
        return Path(override).expanduser()
    if os.environ.get("SKINSOURCE_DATA"):
        return user_folder() / "cache"
    return Path(platformdirs.user_cache_dir("skinsource", appauthor=False))


def config_folder() -> Path:
    """Return the folder of the settings; SKINSOURCE_CONFIG overrides it, and SKINSOURCE_DATA."""
    override = os.environ.get("SKINSOURCE_CONFIG")
    if override:
        return Path(override).expanduser()
    if os.environ.get("SKINSOURCE_DATA"):
        return user_folder() / "config"
    return Path(platformdirs.user_config_dir("skinsource", appauthor=False))
