"""Bars of tabs, and which panels are in sight; shared by tests of docks."""

from PySide6.QtCore import QCoreApplication, QEvent, Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QTabBar


def bars(window):
    """The bars of tabs that the window has; those that Qt gave up are gone for good."""
    QApplication.processEvents()
    QCoreApplication.sendPostedEvents(None, QEvent.Type.DeferredDelete)
    direct = Qt.FindChildOption.FindDirectChildrenOnly
    return window.findChildren(QTabBar, options=direct)


def titles(bar):
    return [bar.tabText(k) for k in range(bar.count())]


def bar_with(window, title):
    return next(bar for bar in bars(window) if title in titles(bar) and bar.count() > 1)


def click_tab(window, title):
    bar = bar_with(window, title)
    at = bar.tabRect(titles(bar).index(title)).center()
    QTest.mouseClick(bar, Qt.MouseButton.LeftButton, pos=at)
    QApplication.processEvents()


def in_sight(window):
    return {panel.name for panel in window.panels if panel.isVisible()}
