"""Pages of help: keys and mouse, about."""

from collections.abc import Callable, Iterable, Sequence
from functools import partial
from html import escape
from typing import Any

from PySide6.QtCore import QObject, Qt, QTimer
from PySide6.QtGui import QAction
from PySide6.QtWidgets import QDialog, QDialogButtonBox, QTextBrowser, QVBoxLayout, QWidget

from skinsource.version import __version__
from skinsource_gui import pages
from skinsource_gui.qt.keys import KEYS, MOUSE, native_text
from skinsource_gui.shell.actions.spec import ActionSpec
from skinsource_gui.shell.menus import BESIDES, Palette
from skinsource_gui.state.document import Document
from skinsource_gui.state.job_runner import JobRunner
from skinsource_gui.state.preferences import InstalledLimbs, Preferences

_ABOUT = f"""
<h3>SkinSource studio {__version__}</h3>
<p>Design vibrotactile stimuli and see how they travel across hand and arm. BSD-3-Clause.</p>
<p>Please cite the work it rests on: Tummala, Reardon, Fani, Goetz, Bianchi, Visell, <i>SkinSource:
A Data-Driven Toolbox for Predicting Touch-Elicited Vibrations in the Upper Limb</i>, IEEE Haptics
Symposium 2024, <a href="https://doi.org/10.1109/HAPTICS59260.2024.10520852">doi&nbsp;10.1109/HAPTICS59260.2024.10520852</a>,
and its dataset,
<a href="https://doi.org/10.5281/zenodo.10547601">doi&nbsp;10.5281/zenodo.10547601</a>.</p>
"""


def keys_page(actions: Iterable[ActionSpec], parent: QWidget, heading: str = "") -> QDialog:
    """Every shortcut and what the mouse does, on one page; ``heading`` is at its top."""
    rows: list[tuple[str, str | None]] = []
    for group in (*MOUSE.values(), *KEYS.values()):
        rows += [(group.heading, None)]
        rows += [(gesture.shown, gesture.effect) for gesture in group.gestures.values()]
    rows += [("Everywhere", None)]
    rows += [
        (native_text(action.keys), f"{action.text} – {action.hint}")
        for action in actions
        if action.keys
    ]
    cells = "".join(
        f'<tr><td colspan=2><h3><a name="{escape(left)}"></a>{escape(left)}</h3></td></tr>'
        if right is None
        else f"<tr><td><b>{escape(left)}</b>&nbsp;&nbsp;</td><td>{escape(right)}</td></tr>"
        for left, right in rows
    )
    page = _page("Keys and mouse", f"<table cellpadding=2>{cells}</table>", parent)
    # Where a heading lies is known once the page has its size.
    QTimer.singleShot(0, page, partial(_scroll_to, page, heading))
    return page


def about_page(parent: QWidget) -> QDialog:
    """Version, licence, and what to cite."""
    return _page("About SkinSource studio", _ABOUT, parent)


def _scroll_to(page: QDialog, heading: str) -> None:
    if heading:
        for text in page.findChildren(QTextBrowser, "page_text"):
            text.scrollToAnchor(heading)


def _page(title: str, html: str, parent: QWidget) -> QDialog:
    dialog = QDialog(parent)
    dialog.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
    dialog.setWindowTitle(title)
    dialog.resize(720, 560)
    browser = QTextBrowser()
    browser.setObjectName("page_text")
    browser.setHtml(html)
    browser.setOpenExternalLinks(True)
    buttons = QDialogButtonBox(QDialogButtonBox.StandardButton.Close)
    buttons.rejected.connect(dialog.reject)
    layout = QVBoxLayout(dialog)
    layout.addWidget(browser)
    layout.addWidget(buttons)
    return dialog


# The pages that open in front of the window, or beside it.

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
        keys_page(self._specs, self._window, heading).open()

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
        about_page(self._window).open()

    def _gestures(self) -> list[QAction]:
        """What the mouse does, to be found; each leads to where the keys page says it."""
        entries = []
        for group in MOUSE.values():
            for gesture in group.gestures.values():
                movement = f"{gesture.shown[:1].lower()}{gesture.shown[1:]}"
                entry = QAction(f"Mouse: {gesture.effect} – {movement}")
                entry.setToolTip(f"{group.heading}; Enter shows all of them")
                entry.setProperty(BESIDES, True)
                entry.triggered.connect(partial(self._show_gestures, group.heading))
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
    return (
        lambda parent: pages.DatasetPage(runner, limbs, parent),
        lambda parent: pages.LimbPage(runner, limbs, parent),
        lambda parent: pages.CheckingPage(runner, document, preferences, parent),
    )
