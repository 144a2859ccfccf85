"""Finds out whether Qt can start, before it is imported, and what to install if not.

``python -m skinsource_gui.qt.system_libraries`` prints the command to run.
"""

import ctypes
import importlib
import os
import sys
from pathlib import Path

#: Libraries that Qt loads on Linux, and the Debian package of each.
_ALWAYS = {
    "libGL.so.1": "libgl1",
    "libEGL.so.1": "libegl1",
    "libxkbcommon.so.0": "libxkbcommon0",
    "libfontconfig.so.1": "libfontconfig1",
    "libdbus-1.so.3": "libdbus-1-3",
    "libglib-2.0.so.0": "libglib2.0-0",
}
_ON_A_SCREEN = {
    "libxcb-cursor.so.0": "libxcb-cursor0",
    "libxcb-icccm.so.4": "libxcb-icccm4",
    "libxcb-image.so.0": "libxcb-image0",
    "libxcb-keysyms.so.1": "libxcb-keysyms1",
    "libxcb-randr.so.0": "libxcb-randr0",
    "libxcb-render-util.so.0": "libxcb-render-util0",
    "libxcb-shape.so.0": "libxcb-shape0",
    "libxcb-xkb.so.1": "libxcb-xkb1",
    "libxkbcommon-x11.so.0": "libxkbcommon-x11-0",
}


def has_display() -> bool:
    """Return whether there is a screen for windows."""
    if os.environ.get("QT_QPA_PLATFORM") in {"offscreen", "minimal"}:
        return False
    if not sys.platform.startswith("linux"):
        return True
    return bool(os.environ.get("DISPLAY") or os.environ.get("WAYLAND_DISPLAY"))


def missing_packages(*, on_a_screen: bool) -> list[str]:
    """Return the missing Debian packages that Qt needs; none on other systems than Linux."""
    if not sys.platform.startswith("linux"):
        return []
    needed = _ALWAYS | (_ON_A_SCREEN if on_a_screen else {})
    return [package for library, package in needed.items() if not _opens(library)]


def install_line(packages: list[str]) -> str:
    """Return the command that installs ``packages`` on Debian and Ubuntu."""
    rights = "" if os.geteuid() == 0 else "sudo "
    return f"{rights}apt-get install -y {' '.join(packages)}"


def started_platform(_: Path) -> str:
    """Start Qt and return on which platform, or what to install; the path is not read."""
    if missing := missing_packages(on_a_screen=has_display()):
        return f"does not start. Install libraries of the system with: {install_line(missing)}"
    if not has_display():
        os.environ["QT_QPA_PLATFORM"] = "offscreen"
    gui = importlib.import_module("PySide6.QtGui")
    name = gui.QGuiApplication([]).platformName()
    return f"starts, platform {name}"


def _opens(library: str) -> bool:
    try:
        ctypes.CDLL(library)
    except OSError:
        return False
    return True


def main() -> int:
    """Print what is missing to run without a screen, as tests do; return 1 if anything is."""
    missing = missing_packages(on_a_screen=False)
    if missing:
        sys.stderr.write(
            f"Qt cannot start: install its libraries first.\n{install_line(missing)}\n"
        )
    return int(bool(missing))


if __name__ == "__main__":
    sys.exit(main())
