"""A studio to be measured or photographed, and a mouse in it."""

import os
import tempfile
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Any

os.environ.setdefault("QT_QPA_PLATFORM", "offscreen")
os.environ.setdefault("PYQTGRAPH_QT_LIB", "PySide6")

from PySide6.QtCore import QEvent, QPoint, QPointF, Qt
from PySide6.QtGui import QMouseEvent
from PySide6.QtWidgets import QApplication, QWidget

from skinsource.design.design import Design, View
from skinsource.limbs.catalog import available_limbs
from skinsource_gui.app.app import make_application
from skinsource_gui.shell.window import MainWindow
from skinsource_gui.state.preferences import Preferences

PRESS, MOVE, RELEASE = (
    QEvent.Type.MouseButtonPress,
    QEvent.Type.MouseMove,
    QEvent.Type.MouseButtonRelease,
)
LEFT, NONE = Qt.MouseButton.LeftButton, Qt.MouseButton.NoButton
BARE, FINE = Qt.KeyboardModifier.NoModifier, Qt.KeyboardModifier.ControlModifier


@contextmanager
def studio(
    design: Design,
    view: View | None = None,
    size: tuple[int, int] = (1366, 768),
    *,
    theme: str = "system",
    limbs: Sequence[str] = (),
    kind: type[MainWindow] = MainWindow,
) -> Iterator[Any]:
    """Show a window with preferences of its own, and close it in the end without a question."""
    if QApplication.instance() is None:
        make_application()
    with tempfile.TemporaryDirectory() as folder:
        preferences = Preferences(Path(folder) / "studio.ini")
        preferences.theme_name = theme
        window = kind(
            design, view=view, preferences=preferences, available_limbs=limbs or available_limbs()
        )
        window.resize(*size)
        window.show()
        try:
            yield window
        finally:
            window.close_unasked()


def settle(window: MainWindow) -> None:
    """Wait until everything is computed and painted."""
    for _ in range(2):
        QApplication.processEvents()
        window.catch_up()
    QApplication.processEvents()


def send_mouse(
    widget: QWidget, kind: QEvent.Type, at: QPointF | QPoint, held: Qt.KeyboardModifier = BARE
) -> None:
    """Press, move or release the left button at a place of a widget."""
    here = QPointF(at)
    button, buttons = NONE if kind == MOVE else LEFT, NONE if kind == RELEASE else LEFT
    there = QPointF(widget.mapToGlobal(here))
    QApplication.sendEvent(widget, QMouseEvent(kind, here, there, button, buttons, held))
