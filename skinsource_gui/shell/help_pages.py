"""Pages of help: keys and mouse, about."""

from collections.abc import Iterable
from functools import partial
from html import escape

from PySide6.QtCore import Qt, QTimer
from PySide6.QtWidgets import QDialog, QDialogButtonBox, QTextBrowser, QVBoxLayout, QWidget

from skinsource.version import __version__
from skinsource_gui.shell.action_spec import ActionSpec
from skinsource_gui.widgets.keys import KEYS, MOUSE, native_text

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
    for place in (*MOUSE.values(), *KEYS.values()):
        rows += [(place.heading, None)]
        rows += [(gesture.shown, gesture.effect) for gesture in place.gestures.values()]
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
