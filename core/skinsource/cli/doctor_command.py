"""``skinsource doctor``: what is installed here, and what works."""

import argparse
import platform
import re
import sys
from collections import defaultdict
from importlib.metadata import PackageNotFoundError, requires, version
from typing import Any

from skinsource.base.assets import cache_folder, config_folder, user_folder
from skinsource.base.errors import PlaybackError, RecordingError
from skinsource.base.extras import extra_cure, in_folder
from skinsource.base.run_limited import run_limited
from skinsource.lab.playing.devices import devices
from skinsource.limbs.catalog import available_limbs
from skinsource.version import __version__

_REQUIREMENT = re.compile(r"([\w.-]+)[^;]*(?:;.*extra == ['\"]([\w-]+)['\"])?")


def add_to(subparsers: Any) -> None:
    """Add the command ``doctor``."""
    doctor = subparsers.add_parser(
        "doctor",
        help="say what is installed here, and what works",
        description="Says which packages and extras are installed, whether the window can open, "
        "which sound devices there are, and where data lie. Send this with a report of a fault.",
    )
    doctor.set_defaults(run=_doctor)


def _doctor(_: argparse.Namespace) -> None:
    lines = {
        "skinsource": __version__,
        "Python": f"{platform.python_version()}, {sys.executable}",
        "system": platform.platform(),
        **_packages(),
        "Qt": _qt(),
        "sound": _sound(),
        "limbs": ", ".join(available_limbs()),
        "data": str(user_folder()),
        "settings": str(config_folder()),
        "cache": str(cache_folder()),
    }
    opens = lines["Qt"].startswith("starts")
    studio = "./skinsource-gui" if in_folder() else "skinsource-gui"
    lines["next"] = f"open the studio with: {studio}" if opens else "do what the line Qt says"
    for name, text in lines.items():
        sys.stdout.write(f"{name:<12}{text}\n")


def _packages() -> dict[str, str]:
    """Return what is installed, by the extra that it comes with."""
    by_extra = defaultdict(list)
    for requirement in requires("skinsource") or ():
        if found := _REQUIREMENT.match(requirement):
            by_extra[found[2] or "library"].append(found[1])
    # It names the other extras.
    by_extra.pop("all", None)
    return {extra: _versions(extra, names) for extra, names in by_extra.items()}


def _versions(extra: str, names: list[str]) -> str:
    try:
        return ", ".join(f"{name} {version(name)}" for name in names)
    except PackageNotFoundError as error:
        return f"{error.name} is missing. {extra_cure(extra)}"


def _qt() -> str:
    """Return how Qt starts, which a process of its own finds out: where it cannot, it crashes."""
    function = "skinsource_gui.qt.system_libraries:started_platform"
    try:
        (text,) = run_limited(function, user_folder(), expected="a window")
    except RecordingError:
        return (
            "does not start. Install what the line gui says; if it says nothing, start "
            "skinsource-gui with QT_DEBUG_PLUGINS=1 in the environment, which tells why"
        )
    return str(text)


def _sound() -> str:
    try:
        found = devices()
    except PlaybackError as error:
        return str(error)
    return "; ".join(device.title for device in found) or "no device that plays"
