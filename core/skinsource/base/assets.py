"""The one place that knows where the library's own data and the user's data lie."""

import os
from pathlib import Path

import platformdirs

PACKAGE = Path(__file__).resolve().parents[1]


def data_folder() -> Path:
    """Folder of what the library ships: in the wheel ``skinsource/_data``, else ``data/``."""
    installed = PACKAGE / "_data"
    return installed if installed.is_dir() else PACKAGE.parents[1] / "data"


def user_folder() -> Path:
    """Folder of what the user installs; the environment variable SKINSOURCE_DATA overrides it."""
    override = os.environ.get("SKINSOURCE_DATA")
    if override:
        return Path(override).expanduser()
    return Path(platformdirs.user_data_dir("skinsource", appauthor=False))


def cache_folder() -> Path:
    """Folder of what can be made again; SKINSOURCE_CACHE overrides it, and SKINSOURCE_DATA."""
    override = os.environ.get("SKINSOURCE_CACHE")
    if override:
        return Path(override).expanduser()
    if os.environ.get("SKINSOURCE_DATA"):
        return user_folder() / "cache"
    return Path(platformdirs.user_cache_dir("skinsource", appauthor=False))


def config_folder() -> Path:
    """Folder of the user's settings; SKINSOURCE_CONFIG overrides it, and SKINSOURCE_DATA."""
    override = os.environ.get("SKINSOURCE_CONFIG")
    if override:
        return Path(override).expanduser()
    if os.environ.get("SKINSOURCE_DATA"):
        return user_folder() / "config"
    return Path(platformdirs.user_config_dir("skinsource", appauthor=False))
