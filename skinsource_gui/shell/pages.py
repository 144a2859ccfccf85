"""The pages that open in front of the window, or beside it."""

import importlib
from collections.abc import Callable, Sequence
from functools import partial
from typing import Any

from PySide6.QtCore import QObject
from PySide6.QtGui import QAction
from PySide6.QtWidgets import QDialog, QWidget

from skinsource_gui.shell import help_pages
from skinsource_gui.shell.action_spec import ActionSpec
from skinsource_gui.shell.palette import BESIDES, Palette
from skinsource_gui.state.document import Document
from skinsource_gui.state.installed_limbs import InstalledLimbs
from skinsource_gui.state.job_runner import JobRunner
from skinsource_gui.state.preferences import Preferences
from skinsource_gui.widgets.keys import MOUSE

#: Makes a page in front of a window.
MakePage = Callable[[QWidget], QDialog]


class Pages(QObject):
    """Opens the pages of one window.

    Parameters
    ----------
    window
        In front of which they open; also the parent.
    specs
        What the keys page lists.
    findable
        Gives what the palette finds; actions without a parent are the palette's.
    make_accuracy, make_dataset, make_limbs, make_check, make_motion
        Make the pages that take long to import, once they are wanted.
    """

    def __init__(
        self,
        window: QWidget,
        specs: Sequence[ActionSpec],
        findable: Callable[[], list[QAction]],
        make_accuracy: MakePage,
        make_dataset: MakePage,
        make_limbs: MakePage,
        make_check: MakePage,
        make_motion: MakePage,
    ) -> None:
        super().__init__(window)
        self._window, self._specs, self._findable = window, specs, findable
        self._make_accuracy, self._make_dataset = make_accuracy, make_dataset
        self._make_limbs, self._make_motion = make_limbs, make_motion
        self._make_check = make_check
        self.accuracy: Any = None

    def search(self) -> None:
        """Open the palette."""
        Palette([*self._findable(), *self._gestures()], self._window).open()

    def show_accuracy(self) -> None:
        """Open the page on errors and times, which stands beside the window."""
        if self.accuracy is None:
            # It keeps what was measured while it is closed.
            self.accuracy = self._make_accuracy(self._window)
        self.accuracy.show()
        self.accuracy.raise_()
        self.accuracy.activateWindow()

    def show_keys(self, heading: str = "") -> None:
        """Open the page of keys and mouse, with a heading at its top."""
        help_pages.keys_page(self._specs, self._window, heading).open()

    def show_dataset(self) -> None:
        """Open the page on the measured limbs."""
        self._make_dataset(self._window).open()

    def show_limbs(self) -> None:
        """Open the page on limbs of one's own."""
        self._make_limbs(self._window).open()

    def show_check(self) -> None:
        """Open the page that holds predictions against recordings."""
        self._make_check(self._window).open()

    def show_motion(self) -> None:
        """Open the page that makes up a motion."""
        self._make_motion(self._window).open()

    def show_about(self) -> None:
        """Open the page on version, licence and citation."""
        help_pages.about_page(self._window).open()

    def _gestures(self) -> list[QAction]:
        """What the mouse does, to be found; each leads to where the keys page says it."""
        entries = []
        for place in MOUSE.values():
            for gesture in place.gestures.values():
                movement = f"{gesture.shown[:1].lower()}{gesture.shown[1:]}"
                entry = QAction(f"Mouse: {gesture.effect} – {movement}")
                entry.setToolTip(f"{place.heading}; Enter shows all of them")
                entry.setProperty(BESIDES, True)
                entry.triggered.connect(partial(self._show_gestures, place.heading))
                entries.append(entry)
        return entries

    def _show_gestures(self, heading: str, _checked: bool = False) -> None:
        self.show_keys(heading)

    def end(self) -> None:
        """Close what stands beside the window, and stop what runs."""
        if self.accuracy is not None:
            self.accuracy.close()


def limb_pages(
    runner: JobRunner,
    limbs: InstalledLimbs,
    document: Document,
    preferences: Preferences,
) -> tuple[MakePage, MakePage, MakePage]:
    """What makes the pages on the measured limbs, on one's own, and on recordings of them."""
    checked = runner, document, preferences
    return (
        late("skinsource_gui.dataset_page.page", "DatasetPage", runner, limbs),
        late("skinsource_gui.limb_page.page", "LimbPage", runner, limbs),
        late("skinsource_gui.checking_page.page", "CheckingPage", *checked),
    )


def late(module: str, name: str, *arguments: object) -> MakePage:
    """Return what makes the page ``name`` of ``module``; imported when it is first wanted.

    Few open such a page; the start of the studio shall not wait for it.
    """

    def make(parent: QWidget) -> QDialog:
        page = getattr(importlib.import_module(module), name)
        return page(*arguments, parent)

    return make
