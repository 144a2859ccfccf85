"""Menus that a test has a panel show."""

from PySide6.QtCore import QCoreApplication, QEvent
from PySide6.QtGui import QContextMenuEvent
from PySide6.QtWidgets import QApplication, QMenu

MOUSE, KEYBOARD = QContextMenuEvent.Reason.Mouse, QContextMenuEvent.Reason.Keyboard


def close_menus(owner, name):
    for menu in owner.findChildren(QMenu, name):
        menu.close()
    QCoreApplication.sendPostedEvents(None, QEvent.Type.DeferredDelete)


def lines_of(owner, name, show):
    """Close a menu and have it shown anew; return its lines by their words."""
    close_menus(owner, name)
    show()
    (menu,) = owner.findChildren(QMenu, name)
    return {action.text().split("\t")[0]: action for action in menu.actions() if action.text()}


def lines_at(owner, name, widget, at, reason=MOUSE):
    """Ask for the menu of a place of a widget; return its lines by their words."""
    event = QContextMenuEvent(reason, at, widget.mapToGlobal(at))
    return lines_of(owner, name, lambda: QApplication.sendEvent(widget, event))
