"""Arrangements of the docks to start from."""

from collections.abc import Mapping

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QDockWidget, QMainWindow

_ACROSS, _DOWN = Qt.Orientation.Horizontal, Qt.Orientation.Vertical


def arrange_design(window: QMainWindow, docks: Mapping[str, QDockWidget]) -> None:
    """Place and edit on the left, the skin in the middle, tracks and curves on the right."""
    _columns(window, docks)
    width, height = window.width(), window.height()
    _show(docks, *docks)
    window.resizeDocks(
        [docks["hand"], docks["skin"], docks["inputs"]],
        [int(width * 0.23), int(width * 0.27), int(width * 0.50)],
        _ACROSS,
    )
    window.resizeDocks([docks["hand"], docks["inspector"]], [height * 42, height * 58], _DOWN)
    window.resizeDocks(
        [docks["inputs"], docks["traces"], docks["spectra"]],
        [int(height * 0.26), int(height * 0.37), int(height * 0.37)],
        _DOWN,
    )


def arrange_analysis(window: QMainWindow, docks: Mapping[str, QDockWidget]) -> None:
    """The skin on the left, traces over spectra on the right."""
    _columns(window, docks)
    _show(docks, "skin", "traces", "spectra")
    width, height = window.width(), window.height()
    window.resizeDocks([docks["skin"], docks["traces"]], [width * 32, width * 68], _ACROSS)
    window.resizeDocks([docks["traces"], docks["spectra"]], [height, height], _DOWN)


def arrange_presentation(window: QMainWindow, docks: Mapping[str, QDockWidget]) -> None:
    """The hand beside the skin."""
    _columns(window, docks)
    _show(docks, "hand", "skin")
    width = window.width()
    window.resizeDocks([docks["hand"], docks["skin"]], [width, width], _ACROSS)


def _columns(window: QMainWindow, docks: Mapping[str, QDockWidget]) -> None:
    for dock in docks.values():
        dock.setFloating(False)
        window.removeDockWidget(dock)
    window.addDockWidget(Qt.DockWidgetArea.TopDockWidgetArea, docks["hand"])
    window.splitDockWidget(docks["hand"], docks["skin"], _ACROSS)
    window.splitDockWidget(docks["skin"], docks["inputs"], _ACROSS)
    window.splitDockWidget(docks["hand"], docks["inspector"], _DOWN)
    window.splitDockWidget(docks["inputs"], docks["traces"], _DOWN)
    window.splitDockWidget(docks["traces"], docks["spectra"], _DOWN)


def _show(docks: Mapping[str, QDockWidget], *names: str) -> None:
    for name, dock in docks.items():
        dock.setVisible(name in names)
