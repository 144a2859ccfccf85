"""Colours, fonts, spacings and icons of the window, and whether it is drawn on paper.

Painting code asks `current_theme` each time; labels get their colour from the style sheet by
`set_tone`.  Icons and other copies of a colour are made again on a change of the palette.
"""

import tomllib
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from contextvars import ContextVar
from dataclasses import dataclass
from string import Template
from typing import Any

from PySide6 import QtGui, QtWidgets
from PySide6.QtCore import Qt
from PySide6.QtSvg import QSvgRenderer

from skinsource_gui.qt.resources import read_text

#: The unit of all distances, px.
UNIT_PX = 8
# Height of a line of letters of the usual size, px.
_USUAL_LINE_PX = 14

# Dashes and gaps of lines, px: solid lines, then those of outputs with a repeated colour.
_STROKES = ((), (5.0, 3.0), (2.0, 2.0), (7.0, 2.0, 2.0, 2.0))


@dataclass(frozen=True, slots=True, kw_only=True)
class Theme:
    """One set of colours, as ``#rrggbb``.

    Attributes
    ----------
    name
        ``"light"`` or ``"dark"``.
    window, base, raised, border, grid
        Background; background of plots and lists; buttons; borders; plot grids.
    text, dim, disabled
        Text; text of less weight (still 4.5 : 1 against ``window``); disabled text.
    accent, on_accent
        Focus and selection, and text on it.
    warning, error
        Amber and red.
    skin, skin_line
        Fill and lines of the drawn hand.
    inputs, outputs
        One categorical palette each, safe for colour-vision deficiencies.
    """

    name: str
    window: str
    base: str
    raised: str
    border: str
    grid: str
    text: str
    dim: str
    disabled: str
    accent: str
    on_accent: str
    warning: str
    error: str
    skin: str
    skin_line: str
    inputs: tuple[str, ...]
    outputs: tuple[str, ...]

    def input_colour(self, number: int) -> QtGui.QColor:
        """Return the colour of an input, by `Input.colour`."""
        return QtGui.QColor(self.inputs[number % len(self.inputs)])

    def output_colour(self, rank: int) -> QtGui.QColor:
        """Return the colour of a selected output, by its rank in the selection."""
        return QtGui.QColor(self.outputs[rank % len(self.outputs)])

    def output_pen(self, rank: int, width_px: float, unit_px: float = 1.0) -> QtGui.QPen:
        """Return the pen of a selected output; where colours repeat, dashes differ.

        Parameters
        ----------
        rank
            Its rank in the selection; 32 pens differ.
        width_px
            Width of the line; 0 is one pixel of the screen.
        unit_px
            Factor of the lengths of dashes.
        """
        pen = QtGui.QPen(self.output_colour(rank), width_px)
        strokes = _STROKES[rank // len(self.outputs) % len(_STROKES)]
        if strokes:
            # Qt measures dashes in widths of the pen.
            pen.setDashPattern([stroke * unit_px / (width_px or 1.0) for stroke in strokes])
            pen.setCapStyle(Qt.PenCapStyle.FlatCap)
        return pen

    def pale(self, colour: QtGui.QColor) -> QtGui.QColor:
        """Return a colour through which the ground is seen."""
        pale = QtGui.QColor(colour)
        pale.setAlphaF(0.45)
        return pale

    def axis_colour(self, rank: int) -> QtGui.QColor:
        """Return the colour of an axis of the sensors, which differs from those of outputs."""
        return QtGui.QColor((*self.inputs[:2], self.text)[rank % 3])


def _theme(name: str, row: Mapping[str, Any]) -> Theme:
    colours: dict[str, Any] = {
        part: tuple(colour) if isinstance(colour, list) else colour for part, colour in row.items()
    }
    return Theme(name=name, **colours)


_TABLE = tomllib.loads(read_text("themes.toml"))
LIGHT, DARK = (_theme(name, _TABLE[name]) for name in ("light", "dark"))
CONTRAST = _theme("contrast", _TABLE["dark"] | _TABLE["contrast"])
THEMES = {theme.name: theme for theme in (LIGHT, DARK, CONTRAST)}
_in_use = LIGHT


def current_theme() -> Theme:
    """Return the theme in use."""
    return _in_use


@contextmanager
def drawn_in(theme: Theme) -> Iterator[None]:
    """Use another theme for painting in this block, as on a page."""
    global _in_use
    before, _in_use = _in_use, theme
    try:
        yield
    finally:
        _in_use = before


def set_tone(widget: QtWidgets.QWidget, tone: str) -> None:
    """Give the text of a widget a colour: ``"dim"``, ``"warning"``, ``"error"``, or "": usual."""
    if (widget.property("tone") or "") != tone:
        widget.setProperty("tone", tone)
        if widget.testAttribute(Qt.WidgetAttribute.WA_WState_Polished):
            widget.style().unpolish(widget)
            widget.style().polish(widget)


def theme_label(name: str) -> str:
    """Return the name of a theme, or of the choice of the system's, in menus and lists."""
    return "High contrast" if name == CONTRAST.name else name.capitalize()


def apply_theme(app: QtWidgets.QApplication, theme: Theme, text_scale: float = 1.0) -> None:
    """Give every widget of ``app`` the colours of ``theme`` and the size of letters.

    ``text_scale`` is 1 for the size of the desktop.  Without a change nothing is done, because Qt
    would go through all widgets.
    """
    global _in_use
    _in_use = theme
    font = scaled(
        QtGui.QFontDatabase.systemFont(QtGui.QFontDatabase.SystemFont.GeneralFont), text_scale
    )
    font = letter_by_letter(font)
    sheet = _sheet(theme)
    if sheet == app.styleSheet() and font == app.font():
        return
    if not app.styleSheet():  # else it has the style already, and would go through all widgets
        app.setStyle("Fusion")
    if font != app.font():
        app.setFont(font)
    app.setPalette(_palette(theme))
    app.setStyleSheet(sheet)


def scaled(font: QtGui.QFont, scale: float) -> QtGui.QFont:
    """Return a copy of ``font`` that is ``scale`` times as large."""
    copy = QtGui.QFont(font)
    if copy.pointSizeF() > 0:
        copy.setPointSizeF(copy.pointSizeF() * scale)
    else:
        copy.setPixelSize(round(copy.pixelSize() * scale))
    return copy


def letter_scale(font: QtGui.QFont) -> float:
    """Return how much larger than usual the letters of ``font`` are; at least 1."""
    return max(QtGui.QFontMetrics(font).height() / _USUAL_LINE_PX, 1.0)


def letter_by_letter(font: QtGui.QFont) -> QtGui.QFont:
    """Return a copy of ``font`` without ligatures, which a search on a PDF page does not find."""
    copy = QtGui.QFont(font)
    copy.setFeature(QtGui.QFont.Tag("liga"), 0)
    return copy


def tabular(font: QtGui.QFont) -> QtGui.QFont:
    """Return a copy of ``font`` in which all digits have the same width."""
    copy = letter_by_letter(font)
    copy.setFeature(QtGui.QFont.Tag("tnum"), 1)
    return copy


def _sheet(theme: Theme) -> str:
    colours = {name: getattr(theme, name) for name in Theme.__slots__}
    values = {name: value for name, value in colours.items() if isinstance(value, str)}
    return Template(read_text("theme.qss")).substitute(values)


def _palette(theme: Theme) -> QtGui.QPalette:
    role = QtGui.QPalette.ColorRole
    palette = QtGui.QPalette()
    for part, colour in {
        role.Window: theme.window,
        role.WindowText: theme.text,
        role.Base: theme.base,
        role.AlternateBase: theme.window,
        role.Text: theme.text,
        role.PlaceholderText: theme.dim,
        role.Button: theme.raised,
        role.ButtonText: theme.text,
        role.ToolTipBase: theme.raised,
        role.ToolTipText: theme.text,
        role.Highlight: theme.accent,
        role.HighlightedText: theme.on_accent,
        role.Link: theme.accent,
        role.Mid: theme.border,
    }.items():
        palette.setColor(part, QtGui.QColor(colour))
    disabled = QtGui.QPalette.ColorGroup.Disabled
    for part in (role.WindowText, role.Text, role.ButtonText):
        palette.setColor(disabled, part, QtGui.QColor(theme.disabled))
    return palette


# Pixels of an icon: three times its usual size, so that it is sharp on any screen.
_ICON_PX = 48


def icon_of(name: str) -> QtGui.QIcon:
    """Return an icon of ``resources/icons`` in the present colours, for buttons on or off."""
    icon, drawing = QtGui.QIcon(), read_text(f"icons/{name}.svg")
    for state, colour in (
        (QtGui.QIcon.State.Off, current_theme().text),
        (QtGui.QIcon.State.On, current_theme().on_accent),
    ):
        pixmap = QtGui.QPixmap(_ICON_PX, _ICON_PX)
        pixmap.fill(Qt.GlobalColor.transparent)
        painter = QtGui.QPainter(pixmap)
        QSvgRenderer(drawing.replace("currentColor", colour).encode()).render(painter)
        painter.end()
        icon.addPixmap(pixmap, QtGui.QIcon.Mode.Normal, state)
    return icon


#: Dots per px on paper: so many that the wave between samples is drawn.
PAPER_DOTS = 16.0
_LINE_PX = 1.0

_paper: ContextVar[bool] = ContextVar("paper", default=False)


@contextmanager
def on_paper() -> Iterator[None]:
    """Draw for a page in this block: without focus, and without cached pictures."""
    token = _paper.set(True)
    try:
        yield
    finally:
        _paper.reset(token)


def is_on_paper() -> bool:
    """Return whether a page is drawn now, not the screen."""
    return _paper.get()


def dots_in_px(painter: QtGui.QPainter) -> float:
    """Return the dots per px: pixels of the screen, or dots of a printer."""
    return PAPER_DOTS if is_on_paper() else painter.device().devicePixelRatioF()


def translucent(colour: str | QtGui.QColor, alpha: int) -> QtGui.QColor:
    """Return a colour through which what lies below is seen; an ``alpha`` of 255 is opaque."""
    through = QtGui.QColor(colour)
    through.setAlpha(alpha)
    return through


def thin_pen(colour: QtGui.QColor) -> QtGui.QPen:
    """Return a pen of one pixel of the screen; any wider line takes a hundred times as long.

    On paper it would be invisible: there it is as wide as other lines.
    """
    return QtGui.QPen(colour, _LINE_PX if is_on_paper() else 0.0)
