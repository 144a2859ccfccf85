"""Kinds of waveforms: their icons, their menu, and the field that chooses one."""

from collections.abc import Callable
from functools import lru_cache

import numpy as np
from pyqtgraph.functions import arrayToQPath
from PySide6 import QtGui, QtWidgets
from PySide6.QtCore import QEvent, QPoint, QPointF, QSize, Qt

from skinsource.base.conventions import SAMPLE_RATE_HZ, Floats
from skinsource.base.errors import InvalidInputError
from skinsource.design.waveform import Waveform
from skinsource.design.waveforms import COMMON, kinds
from skinsource.design.waveforms.periodic import PulseTrain, Saw, Square, Triangle
from skinsource.design.waveforms.pulses import DampedSine, Noise
from skinsource.design.waveforms.samples import Drawn, Formula, Recording
from skinsource.design.waveforms.tones import (
    AmplitudeModulated,
    Chirp,
    FrequencyModulated,
    Glide,
    Tone,
)
from skinsource.design.waveforms.wavelet_train import WaveletTrain
from skinsource.design.waveforms.wavelets import Chirplet, Gabor
from skinsource.specs.samples import Samples
from skinsource.specs.spec import ChoiceSpec
from skinsource_gui.fields.choice_field import ChoiceField
from skinsource_gui.qt.buttons import FirstLetters
from skinsource_gui.qt.layouts import named
from skinsource_gui.qt.theme import Theme, current_theme

#: Size of an icon, px.
PICTURE_PX = QSize(30, 18)
#: Largest number of device pixels per px.
SHARPEST = 3
_RATE_HZ = 3000.0
_MARGIN_PX = 2.0
_LINE_PX = 1.2
_DOT_PX = 1.5

_TICKS = np.arange(78.0)

#: The waveform in the icon of a kind, with few periods.  Other kinds have their default values.
_EXAMPLES: tuple[Waveform, ...] = (
    Tone(30.0, 0.0, 0.1, "none"),
    Chirp(10.0, 90.0, 0.1),
    Noise(3, 0.05, 25.0, 300.0, "none"),
    Gabor(100.0, 4.0),
    WaveletTrain((40.0, 70.0, 130.0), 2.0, 0.045),
    Glide(((0.0, 20.0, 0.3), (0.06, 60.0, 1.0), (0.1, 20.0, 0.2))),
    Chirplet(80.0, 2000.0, 0.012),
    DampedSine(60.0, 0.025, 0.1),
    Square(25.0, 0.5, 0.1),
    Saw(25.0, 0.1),
    Triangle(25.0, 0.1),
    PulseTrain(40.0, 0.006, 0.1),
    AmplitudeModulated(90.0, 20.0, 1.0, 0.1),
    FrequencyModulated(70.0, 20.0, 45.0, 0.1),
    Formula("(sin(2*pi*30*t) + sin(2*pi*70*t)) / 2", 0.1),
    Drawn(
        Samples(
            values=np.array([0.0, 0.5, 0.9, 0.4, -0.6, -1.0, -0.3, 0.1, 0.0, 0.2, 0.7, 0.3, 0.0]),
            sample_rate_hz=SAMPLE_RATE_HZ,
        )
    ),
    Recording(np.exp(-_TICKS / 18) * (np.sin(_TICKS * 1.1) + np.sin(_TICKS**1.37)) / 2),
)


@lru_cache(maxsize=128)
def waveform_icon(kind: type[Waveform], theme: Theme) -> QtGui.QIcon:
    """Return the icon of a kind of waveform in the colours of a theme."""
    icon, path = QtGui.QIcon(), _wave(_samples_of(kind))
    for mode, colour in (
        (QtGui.QIcon.Mode.Normal, theme.text),
        (QtGui.QIcon.Mode.Active, theme.on_accent),
        (QtGui.QIcon.Mode.Selected, theme.on_accent),
        (QtGui.QIcon.Mode.Disabled, theme.dim),
    ):
        for per_px in range(1, SHARPEST + 1):
            icon.addPixmap(drawn_path(path, PICTURE_PX, colour, _LINE_PX, per_px), mode)
    return icon


def _samples_of(kind: type[Waveform]) -> Floats:
    shown = next((waveform for waveform in _EXAMPLES if type(waveform) is kind), None) or kind()
    try:
        return shown.samples(_RATE_HZ)
    except InvalidInputError:
        return np.zeros(2)


def _wave(samples: Floats) -> QtGui.QPainterPath:
    width, height = PICTURE_PX.width(), PICTURE_PX.height()
    middle, reach = height / 2, height / 2 - _MARGIN_PX
    path = QtGui.QPainterPath()
    if samples.size == 1:
        foot, top = QPointF(width / 2, middle), QPointF(width / 2, middle - reach + _DOT_PX)
        for start, end in (
            (QPointF(_MARGIN_PX, middle), QPointF(width - _MARGIN_PX, middle)),
            (foot, top),
        ):
            path.moveTo(start)
            path.lineTo(end)
        path.addEllipse(top, _DOT_PX, _DOT_PX)
    elif samples.size:
        x = np.linspace(_MARGIN_PX, width - _MARGIN_PX, samples.size)
        y = middle - reach * samples / max(np.abs(samples).max(), 1e-300)
        path = arrayToQPath(x, y, finiteCheck=False)
    return path


def drawn_path(
    path: QtGui.QPainterPath, size: QSize, colour: str, line_px: float, per_px: int
) -> QtGui.QPixmap:
    """Return a picture of a path, with ``per_px`` pixels of the screen for each px."""
    picture = QtGui.QPixmap(size * per_px)
    picture.setDevicePixelRatio(per_px)
    picture.fill(Qt.GlobalColor.transparent)
    painter = QtGui.QPainter(picture)
    painter.setRenderHint(QtGui.QPainter.RenderHint.Antialiasing)
    pen = QtGui.QPen(QtGui.QColor(colour), line_px)
    pen.setJoinStyle(Qt.PenJoinStyle.RoundJoin)
    painter.strokePath(path, pen)
    painter.end()
    # Qt keeps with a picture what it painted it with: megabytes for a path of thousands of points.
    return picture.copy()


MORE = "More"


def fill_kind_menu(
    menu: QtWidgets.QMenu, choose: Callable[[str], None], *, current: str = ""
) -> None:
    """Fill a menu with the kinds of waveforms; those that are not common are under "More".

    Parameters
    ----------
    menu
        Gets the entries.
    choose
        Is called with the class name of the chosen kind.
    current
        Class name of the present kind, which is bold.
    """
    _show_pictures(menu)
    common = [kind for kind in kinds() if kind in COMMON]
    for kind in common:
        _add(menu, kind, choose, current)
    others = [kind for kind in kinds() if kind not in COMMON]
    more = named(menu.addMenu(MORE), "more_kinds")
    _show_pictures(more)
    for kind in others:
        _add(more, kind, choose, current)
    FirstLetters(menu, more)
    if current in {kind.__name__ for kind in others}:
        _embolden(more.menuAction())


def _add(
    menu: QtWidgets.QMenu, kind: type[Waveform], choose: Callable[[str], None], current: str
) -> None:
    action = menu.addAction(waveform_icon(kind, current_theme()), kind.title)
    action.setObjectName(f"kind_{kind.__name__}")
    action.triggered.connect(lambda: choose(kind.__name__))
    if kind.__name__ == current:
        _embolden(action)
        menu.setActiveAction(action)


def _embolden(action: QtGui.QAction) -> None:
    font = action.font()
    font.setBold(True)
    action.setFont(font)


def _show_pictures(menu: QtWidgets.QMenu) -> None:
    # Qt makes room for square icons only.
    menu.setStyleSheet(
        f"QMenu {{ icon-size: {PICTURE_PX.width()}px; }}"
        f"QMenu::item {{ padding: 0px 24px 0px 8px; min-height: {PICTURE_PX.width()}px; }}"
    )


class KindField(ChoiceField):
    """A drop-down field of the kinds of waveforms, whose list is their menu.

    A click leaves the keyboard where it is: keys go on to act on the clip.
    """

    def __init__(self, spec: ChoiceSpec, parent: QtWidgets.QWidget | None = None) -> None:
        super().__init__(spec, parent)
        self.setFocusPolicy(Qt.FocusPolicy.TabFocus)
        self._menu: QtWidgets.QMenu | None = None
        self.setIconSize(PICTURE_PX)
        # With its picture it is no wider than other choices.
        self.setMinimumContentsLength(6)
        self.currentIndexChanged.connect(self._picture)
        self._picture()

    def showPopup(self) -> None:
        self.hidePopup()
        menu = named(QtWidgets.QMenu(self), "kind_menu")
        fill_kind_menu(menu, self.choose, current=self.value)
        menu.setMinimumWidth(self.width())
        menu.aboutToHide.connect(menu.deleteLater)
        menu.destroyed.connect(self._forget)
        self._menu = menu
        menu.popup(self.mapToGlobal(QPoint(0, self.height())))

    def hidePopup(self) -> None:
        if self._menu is not None:
            self._menu.close()
        super().hidePopup()

    def changeEvent(self, event: QEvent) -> None:
        super().changeEvent(event)
        if event.type() == QEvent.Type.PaletteChange:
            self._picture()

    def _picture(self) -> None:
        # Only the icon of the present kind: those of noise and of samples need slow imports, which
        # would delay the start of the window.
        for kind in kinds():
            if kind.__name__ == self.currentData():
                icon = waveform_icon(kind, current_theme())
                self.setItemIcon(self.currentIndex(), icon)

    def _forget(self) -> None:
        self._menu = None
