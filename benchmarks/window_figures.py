"""Figures of the window: how much of the screen the skin has, what is in sight, how many controls.

python benchmarks/window_figures.py     (`make pictures` prints them, too)
"""

import os
import sys
import tempfile
from dataclasses import dataclass
from pathlib import Path

os.environ.setdefault("QT_QPA_PLATFORM", "offscreen")
os.environ.setdefault("PYQTGRAPH_QT_LIB", "PySide6")

import numpy as np
from PySide6 import QtGui, QtWidgets
from PySide6.QtCore import QPointF, Qt

from skinsource.design.clips import Clip
from skinsource.design.design import Design, Input
from skinsource.design.waveforms.samples import Drawn
from skinsource.design.waveforms.tones import Tone
from skinsource.design.waveforms.wavelet_train import WaveletTrain
from skinsource_gui.app.app import make_application
from skinsource_gui.panels.skin.map import SkinMap
from skinsource_gui.plots.outputs import output_at
from skinsource_gui.shell.window import MainWindow
from skinsource_gui.state.document import NEW_VIEW
from skinsource_gui.state.preferences import Preferences

#: Screens, and what a title bar and a task bar leave of their height, px.
SCREENS = ((1366, 768), (1440, 900), (1920, 1080), (2560, 1440))
BARS_PX = 80
#: Clips of which all that is needed has to be in sight.
WAVEFORMS = {
    "tone": Tone(),
    "wavelet train": WaveletTrain(),
    "drawn": Drawn(),
}
#: Fields of a clip that are always needed; after them this many of its waveform.
ALWAYS, OF_WAVEFORM = ("location", "amplitude", "onset_s", "duration_s", "kind"), 4
_PLACES = (7, 3, 12, 18, 8)
_TRACKS = len(_PLACES)
_CLICK_PX = 10.0
# Large areas that are no controls, by the names of their objects or classes.
_BODIES = ("skin_map", "hand_diagram", "-plot", "canvas", "lanes", "ruler", "QTabBar")
_CONTAINERS = (
    QtWidgets.QMainWindow,
    QtWidgets.QMenuBar,
    QtWidgets.QDockWidget,
    QtWidgets.QScrollArea,
    QtWidgets.QSplitter,
    QtWidgets.QSplitterHandle,
)


@dataclass(frozen=True, kw_only=True)
class Figures:
    """What is measured of a window on one screen.

    Attributes
    ----------
    skin, arm
        Share of the screen that the coloured skin has, with the hand fitted and with the arm.
    sensors_px, clicked
        Distance of the two nearest sensors in sight with the hand fitted; whether each of them
        takes a click within 10 px.
    traces_px, spectra_px
        Heights of the panels.
    tracks
        Tracks that are wholly in sight.
    hidden
        By waveform, needed fields of the clip that are not wholly in sight.
    controls
        Names of all controls besides menus, places of the hand and fields of the clip.
    """

    skin: float
    arm: float
    sensors_px: float
    clicked: bool
    traces_px: int
    spectra_px: int
    tracks: int
    hidden: dict[str, tuple[str, ...]]
    controls: tuple[str, ...]

    def __str__(self) -> str:
        hidden = "; ".join(
            f"{name}: {', '.join(them)}" for name, them in self.hidden.items() if them
        )
        return (
            f"skin {100 * self.skin:.1f} %, with arm {100 * self.arm:.1f} %, sensors "
            f"{self.sensors_px:.1f} px apart, each clicked: {'yes' if self.clicked else 'no'}, "
            f"traces {self.traces_px} px, spectra {self.spectra_px} px, {self.tracks} of {_TRACKS} "
            f"tracks, hidden fields: {hidden or 'none'}, {len(self.controls)} controls"
        )


def design_of(waveform: object) -> Design:
    """Return a design of five tracks that play ``waveform``."""
    tracks = tuple(
        Input(location=place, clips=(Clip(waveform=waveform),), colour=colour)
        for colour, place in enumerate(_PLACES)
    )
    return Design(limb="synthetic-1", inputs=tracks)


def figures_of(window: MainWindow, screen: tuple[int, int]) -> Figures:
    """Return the figures of a window that is shown, as it would be on ``screen``."""
    window.resize(screen[0], screen[1] - BARS_PX)
    hidden = {}
    for name, waveform in WAVEFORMS.items():
        window.document.start_over(design_of(waveform), NEW_VIEW, None)
        QtWidgets.QApplication.processEvents()
        window.catch_up()
        QtWidgets.QApplication.processEvents()
        hidden[name] = hidden_fields(window.panel("inspector"))
    skin = window.panel("skin").map
    areas = []
    for shown in (True, False):
        skin.stage.show_arm(shown=shown)
        areas.append(coloured_px(skin) / (screen[0] * screen[1]))
    sensors_px, clicked = sensors_of(skin)
    return Figures(
        skin=areas[1],
        arm=areas[0],
        sensors_px=sensors_px,
        clicked=clicked,
        traces_px=window.panel("traces").height(),
        spectra_px=window.panel("spectra").height(),
        tracks=tracks_in_sight(window.panel("timeline")),
        hidden=hidden,
        controls=tuple(map(name_of, controls_of(window))),
    )


def coloured_px(skin: SkinMap) -> int:
    """Return how many pixels of the map are skin in colours."""
    layout, limb_map = skin.stage.layout, skin.content.limb_map
    image = QtGui.QImage(skin.size(), QtGui.QImage.Format.Format_Grayscale8)
    image.fill(0)
    painter = QtGui.QPainter(image)
    painter.setBrush(Qt.GlobalColor.white)
    painter.setPen(Qt.PenStyle.NoPen)
    places = layout.frame.to_screen(limb_map.outline)
    painter.drawPolygon([QPointF(x, y) for x, y in places])
    painter.fillRect(layout.palmar_card, Qt.GlobalColor.black)
    painter.end()
    rows = np.frombuffer(image.constBits(), np.uint8).reshape(image.height(), -1)
    return int(np.count_nonzero(rows[:, : image.width()])) if skin.content.shown_field else 0


def sensors_of(skin: SkinMap) -> tuple[float, bool]:
    """Return the smallest distance of sensors in sight, and whether each takes a near click."""
    points, room = skin.stage.layout.points, skin.stage.layout.room
    seen = [k for k, (x, y) in enumerate(points) if room.contains(x, y)]
    there = points[seen]
    distances = np.linalg.norm(there[:, None] - there[None], axis=-1)
    np.fill_diagonal(distances, np.inf)
    angles = np.linspace(0.0, 2.0 * np.pi, 16, endpoint=False)
    around = 0.99 * _CLICK_PX * np.column_stack((np.cos(angles), np.sin(angles)))
    clicked = all(
        output_at(points, QPointF(*(points[k] + offset))) == k + 1
        for k in seen
        for offset in around
    )
    return float(distances.min()), clicked


def is_in_sight(widget: QtWidgets.QWidget) -> bool:
    """Return whether nothing of a widget is hidden or scrolled away."""
    return widget.isVisible() and widget.visibleRegion().boundingRect() == widget.rect()


def hidden_fields(inspector: QtWidgets.QWidget) -> tuple[str, ...]:
    """Return the needed fields of the clip that are not wholly in sight."""
    fields = {
        widget.objectName().removesuffix("_field"): widget
        for widget in inspector.findChildren(QtWidgets.QWidget)
        if widget.objectName().endswith("_field") and widget.isVisible()
    }
    of_waveform = [name for name in fields if name not in ALWAYS][:OF_WAVEFORM]
    needed = [name for name in (*ALWAYS, *of_waveform) if name in fields]
    return tuple(name for name in needed if not is_in_sight(fields[name]))


def tracks_in_sight(timeline: QtWidgets.QWidget) -> int:
    """Return how many tracks are wholly in sight: rows of the list of heads."""
    for view in timeline.findChildren(QtWidgets.QAbstractItemView):
        model, room = view.model(), view.viewport().rect()
        if view.isVisible() and model is not None:
            rows = (view.visualRect(model.index(row, 0)) for row in range(model.rowCount()))
            return sum(room.top() <= row.top() and row.bottom() <= room.bottom() for row in rows)
    return 0


def controls_of(window: MainWindow) -> list[QtWidgets.QWidget]:
    """Return the visible widgets that take a click or a key; exclusive buttons count once.

    Menus, such as the words of the measure line, places of the hand, fields of the clip, and bodies
    of tracks with their heads, plots and maps are left out.
    """
    inspector = window.panel("inspector")
    found, groups = [], set()
    for widget in window.findChildren(QtWidgets.QWidget):
        if not widget.isVisible() or not _takes_input(widget):
            continue
        if widget.window() is not window or inspector.isAncestorOf(widget):
            continue
        group = _group_of(widget)
        if group is None or group not in groups:
            found.append(widget)
        if group is not None:
            groups.add(group)
    return found


def _takes_input(widget: QtWidgets.QWidget) -> bool:
    if isinstance(widget, _CONTAINERS) or widget.focusProxy() is not None:
        return False
    if isinstance(widget, QtWidgets.QToolButton) and widget.menu() is not None:
        return False
    called = f"{widget.objectName()} {type(widget).__name__}"
    if any(body in called for body in _BODIES) or widget.objectName().startswith("qt_scrollarea"):
        return False
    if isinstance(widget, QtWidgets.QAbstractButton):
        return not isinstance(widget.parentWidget(), QtWidgets.QTabBar)
    return bool(widget.focusPolicy() & Qt.FocusPolicy.TabFocus)


def _group_of(widget: QtWidgets.QWidget) -> object | None:
    """Return what makes buttons exclusive; None for a control by itself."""
    if not isinstance(widget, QtWidgets.QAbstractButton):
        return None
    if widget.group() is not None and widget.group().exclusive():
        return widget.group()
    action = widget.defaultAction() if isinstance(widget, QtWidgets.QToolButton) else None
    group = None if action is None else action.actionGroup()
    return group if group is not None and group.isExclusive() else None


def name_of(widget: QtWidgets.QWidget) -> str:
    """Return how a control is called."""
    text = widget.text() if isinstance(widget, QtWidgets.QAbstractButton) else ""
    return widget.accessibleName() or text or widget.objectName() or type(widget).__name__


def print_figures(*, controls: bool = False) -> None:
    """Print the figures of a new window on each screen."""
    for screen in SCREENS:
        with tempfile.TemporaryDirectory() as folder:
            preferences = Preferences(Path(folder) / "studio.ini")
            window = MainWindow(
                design_of(Tone()), preferences=preferences, available_limbs=["synthetic-1"]
            )
            window.resize(screen[0], screen[1] - BARS_PX)
            window.show()
            window.do("arrange_design")
            figures = figures_of(window, screen)
            print(f"{screen[0]}x{screen[1]}: {figures}")
            if controls:
                print("  " + ", ".join(figures.controls))
            window.document.mark_saved(None)
            window.close()


if __name__ == "__main__":
    make_application()
    print_figures(controls="--controls" in sys.argv)
