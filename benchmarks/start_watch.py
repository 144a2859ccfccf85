"""Starts the studio by its own way in and tells when its window was painted; see ``start.py``."""

import importlib
import json
import os
import sys
import tempfile
from pathlib import Path
from time import monotonic
from types import ModuleType, SimpleNamespace
from typing import Any

#: The collector and the check of the results have run by then.
_REST_MS = 2500


def main() -> None:
    """Start the studio with a watch on its window; never returns."""
    start = importlib.import_module("skinsource_gui.__main__")
    missing_packages = start.missing_packages
    start.has_display = lambda: True
    start.missing_packages = lambda *, on_a_screen: missing_packages(on_a_screen=False)
    start.importlib = SimpleNamespace(import_module=import_watched, util=importlib.util)
    sys.exit(start.main([]))


def import_watched(name: str) -> ModuleType:
    """Import the module of the application; each window it makes is watched."""
    module = importlib.import_module(name)
    if not hasattr(module, "make_window"):
        return module  # the library, which comes before
    make_window = module.make_window

    def make_watched(path: Path | None, preferences: Any) -> Any:
        # The user's own preferences are left alone.
        own = type(preferences)(Path(tempfile.mkdtemp()) / "studio.ini")
        window = make_window(path, own)
        watch(window)
        return window

    module.make_window = make_watched
    return module


def watch(window: Any) -> None:
    """Note when ``window`` is first painted, and when with all results; tell, and end."""
    qt = importlib.import_module("PySide6.QtCore")
    noted: dict[str, float] = {}
    outcomes: list[Any] = []

    class Watch(qt.QObject):
        def eventFilter(self, watched: Any, event: Any) -> bool:
            if event.type() == qt.QEvent.Type.Paint:
                # All of the window is painted before the next event is looked at.
                qt.QTimer.singleShot(0, note)
            return super().eventFilter(watched, event)

    def expect_results(outcome: Any) -> None:
        outcomes.append(outcome)
        window.update()

    def note() -> None:
        noted.setdefault("painted", monotonic())
        if not outcomes:
            return
        noted["complete"] = monotonic()
        if "--rest" in sys.argv:
            qt.QTimer.singleShot(_REST_MS, rest)
        else:
            tell(noted)

    def rest() -> None:
        resident_mb = importlib.import_module("resident").resident_mb
        tell(noted | {"idle_mb": resident_mb()})

    window.conductor.delivered.connect(expect_results)
    window.installEventFilter(Watch(window))


def tell(noted: dict[str, float]) -> None:
    """Hand over what was noted and end, without tidying up."""
    sys.stdout.write(json.dumps(noted))
    sys.stdout.flush()
    os._exit(0)


if __name__ == "__main__":
    main()
