"""The pages that open in front of the window, and the two of help that are made here."""

from collections.abc import Callable, Iterable
from html import escape
from itertools import groupby
from operator import itemgetter
from typing import Any, cast

from PySide6 import QtGui, QtWidgets
from PySide6.QtCore import QObject, Qt, QUrl

from skinsource.base.assets import manual_file
from skinsource.base.conventions import PRE_TRIGGER_DELAY_S
from skinsource.design.design import Design
from skinsource.design.labels import limb_label
from skinsource.export import packing
from skinsource.version import __version__
from skinsource_gui import pages
from skinsource_gui.qt.keys import KEYS, MOUSE, native_text
from skinsource_gui.qt.layouts import in_column, named
from skinsource_gui.qt.resources import read_text
from skinsource_gui.shell.actions import ACTIONS, ActionSpec
from skinsource_gui.shell.docks import PanelInUse
from skinsource_gui.shell.menus import NOTHING_FOUND, Palette, SearchLine
from skinsource_gui.shell.status import StatusLine
from skinsource_gui.state.services import Services

# What a page has room for.
_PICTURE_PX = 640


# Places of keys that are not called as their panel.
_PLACES = {"stage": "presenting", "compare": "snapshot", "inspector": "number", "target": "skin"}
_PLACES |= dict.fromkeys(("traces", "spectra", "output", "analysis", "analysis_2"), "plot")


def keys_page(
    actions: Iterable[ActionSpec], parent: QtWidgets.QWidget, panel: str
) -> QtWidgets.QDialog:
    """Return the page of all shortcuts and of what the mouse does, those of a panel first."""
    first = _PLACES.get(panel, panel)
    groups = sorted((*KEYS.items(), *MOUSE.items()), key=lambda of: of[0] != first)
    rows = [
        (group.heading, gesture.shown, gesture.effect)
        for _, group in groups
        for gesture in group.gestures.values()
    ]
    rows += [
        ("Everywhere", native_text(action.keys), f"{action.text} – {action.hint}")
        for action in actions
        if action.keys
    ]
    page = _page("Keys and mouse", "", parent)
    (browser,) = page.findChildren(QtWidgets.QTextBrowser, "page_text")
    line = named(SearchLine("Search keys and mouse", browser), "keys_search")

    def narrow(letters: str) -> None:
        words, text = letters.lower().split(), ""
        found = [row for row in rows if all(word in " ".join(row).lower() for word in words)]
        for heading, of_place in groupby(found, itemgetter(0)):
            text += f"<tr><td colspan=2><h3>{escape(heading)}</h3></td></tr>"
            for _, keys, effect in of_place:
                text += (
                    f"<tr><td><b>{escape(keys)}</b>&nbsp;&nbsp;</td><td>{escape(effect)}</td></tr>"
                )
        browser.setHtml(f"<table cellpadding=2>{text}</table>" if text else NOTHING_FOUND)

    narrow("")
    line.textChanged.connect(narrow)
    cast("QtWidgets.QVBoxLayout", page.layout()).insertWidget(0, line)
    line.setFocus()
    return page


class _Text(QtWidgets.QTextBrowser):
    """Shows a text with its pictures no wider than the page."""

    def loadResource(self, kind: int, name: QUrl | str) -> Any:
        found = super().loadResource(kind, name)
        if kind != QtGui.QTextDocument.ResourceType.ImageResource.value:
            return found
        image = QtGui.QImage.fromData(found)
        smooth = Qt.TransformationMode.SmoothTransformation
        # Some systems read no WebP.
        return image.scaledToWidth(_PICTURE_PX, smooth) if image.width() > _PICTURE_PX else found


def _page(title: str, html: str, parent: QtWidgets.QWidget) -> QtWidgets.QDialog:
    dialog = QtWidgets.QDialog(parent)
    dialog.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
    dialog.setWindowTitle(title)
    dialog.resize(720, 560)
    browser = named(_Text(), "page_text")
    browser.setHtml(html)
    browser.setOpenExternalLinks(True)
    buttons = QtWidgets.QDialogButtonBox(QtWidgets.QDialogButtonBox.StandardButton.Close)
    buttons.rejected.connect(dialog.reject)
    in_column(browser, buttons, of=dialog)
    return dialog


def _checksums(design: Design) -> str:
    """Return the checksums of the responses that predict a design, and of an own limb."""
    data = packing.data_of(design)
    found = {data["source_name"] or "Responses": data["source_sha256"]}
    found |= {f"Limb {limb_label(design.limb).title}": data["limb_sha256"]}
    lines = (f"{escape(of)}: SHA-256 <code>{sha}</code>" for of, sha in found.items() if sha)
    return f"<p>{'<br>'.join(lines)}</p>"


class Pages(QObject):
    """Opens the pages of one window.

    Parameters
    ----------
    window
        In front of which they open; also the parent.
    findable
        Gives the actions that the palette finds; actions without a parent are the palette's.
    in_use
        Its panel is the first on the page of keys.
    document, preferences, runner, limbs, status_line
        What the pages show and use.
    """

    def __init__(
        self,
        services: Services,
        findable: Callable[[], list[QtGui.QAction]],
        in_use: PanelInUse,
        status_line: StatusLine,
    ) -> None:
        super().__init__(services.window)
        self._window, self._findable, self._in_use = services.window, findable, in_use
        self._document, self._preferences = services.document, services.preferences
        self._panels = services.panels
        self._runner, self._limbs = services.runner, services.limbs
        self._status_line = status_line
        self.accuracy: Any = None

    def search(self) -> None:
        """Open the palette."""
        Palette(self._findable(), self._window).open()

    def show_accuracy(self) -> None:
        """Open the page on errors and times, a window of its own."""
        if self.accuracy is None:
            # One page for the session: while it is closed it holds what was measured.
            self.accuracy = pages.AccuracyPage(
                self._runner, self._status_line, self._preferences, self._document, self._window
            )
        self.accuracy.show()
        self.accuracy.raise_()
        self.accuracy.activateWindow()

    def show_keys(self) -> None:
        """Open the page of keys and mouse."""
        keys_page(ACTIONS, self._window, self._in_use.panel.name).open()

    def show_dataset(self) -> None:
        """Open the page on the measured limbs."""
        pages.DatasetPage(self._runner, self._limbs, self._window).open()

    def show_limbs(self) -> None:
        """Open the page on limbs of one's own."""
        pages.LimbPage(self._runner, self._limbs, self._window).open()

    def show_check(self) -> None:
        """Open the page that compares predictions with recordings."""
        pages.CheckingPage(self._runner, self._document, self._preferences, self._window).open()

    def show_motion(self) -> None:
        """Open the page that makes a motion."""
        page = pages.MotionPage(self._document, self._window)
        page.accepted.connect(lambda: self._panels["timeline"].setFocus())
        page.open()

    def show_placement(self) -> None:
        """Open the page that finds where actuators serve best."""
        pages.PlacementPage(self._runner, self._limbs, self._document, self._window).open()

    def show_manual(self) -> None:
        """Open the manual: the site in the browser, or the README and the pages it leads to."""
        address = QUrl.fromLocalFile(str(manual_file()))
        if address.fileName() == "index.html":
            if not QtGui.QDesktopServices.openUrl(address):
                self._window.statusBar().showMessage(f"Open by hand: {address.toLocalFile()}")
            return
        page = _page("Manual", "", self._window)
        (browser,) = page.findChildren(QtWidgets.QTextBrowser, "page_text")
        browser.setSource(address, QtGui.QTextDocument.ResourceType.MarkdownResource)
        page.open()

    def show_about(self) -> None:
        """Open the page on version, licence and citation."""
        about, delay_ms = read_text("about.html"), PRE_TRIGGER_DELAY_S * 1e3
        text = about.format(version=__version__, delay_ms=delay_ms)
        text += _checksums(self._document.design)
        _page("About SkinSource studio", text, self._window).open()

    def end(self) -> None:
        """Close the page on errors and times."""
        if self.accuracy is not None:
            self.accuracy.close()
