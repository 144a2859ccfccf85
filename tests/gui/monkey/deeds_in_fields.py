"""What can be done in fields, lists, pages and menus."""

from PySide6.QtCore import QPoint, Qt
from PySide6.QtWidgets import (
    QAbstractButton,
    QAbstractItemView,
    QApplication,
    QComboBox,
    QDialog,
    QLineEdit,
)

from skinsource_gui.fields.number_field import NumberField
from skinsource_gui.shell.actions import ACTIONS
from tests.gui.monkey.deeds_on_canvases import shown_panel
from tests.gui.monkey.hands import ALT, CONTROL, NONE, SHIFT

#: They end the studio, hide the pointer's screen, or start jobs of a minute.
_LEFT_OUT = {"quit_studio", "toggle_full_screen", "show_accuracy", "show_dataset"}
_ENTRIES = tuple(spec.name for spec in ACTIONS if spec.name not in _LEFT_OUT)
_OFTEN = ("undo", "undo", "redo", "duplicate_input", "save_design")
_Key = Qt.Key
_KEYS = (
    *(_Key.Key_Up, _Key.Key_Down, _Key.Key_Left, _Key.Key_Right, _Key.Key_Space, _Key.Key_Tab),
    *(_Key.Key_Home, _Key.Key_End, _Key.Key_Return, _Key.Key_Escape, _Key.Key_Delete),
    *(_Key.Key_A, _Key.Key_C, _Key.Key_D, _Key.Key_E, _Key.Key_I, _Key.Key_M, _Key.Key_N),
    *(_Key.Key_P, _Key.Key_R, _Key.Key_S, _Key.Key_V, _Key.Key_X, _Key.Key_Y, _Key.Key_Z),
    *(_Key.Key_0, _Key.Key_1, _Key.Key_2, _Key.Key_5, _Key.Key_Plus, _Key.Key_Minus),
    *(_Key.Key_Insert, _Key.Key_PageUp, _Key.Key_Backspace, _Key.Key_F6),
)
_HELD = (NONE, NONE, NONE, SHIFT, CONTROL, CONTROL, ALT)
_TEXTS = (
    *("0", "1", "-0.5", "0.05", "0,2", "20 ms", "150", "0.3 kHz", "440", "1e9", "-3", "12x", ""),
    *("0.1", "0.25 s", "7", "2.5"),
)


def of_menus(hands):
    do(hands, hands.one_of(_OFTEN if hands.chance(0.4) else _ENTRIES))


def do(hands, name):
    """Do what an entry of the menus does."""
    hands.done.append(("do", name))
    hands.window.do(name)


def press_keys(hands):
    name = hands.one_of(("timeline", "timeline", "hand", "clip_editor", "skin", "inspector"))
    if hands.chance(0.3):
        name = hands.one_of(("traces", "spectra", "library"))
    panel = shown_panel(hands, name)
    panel.setFocus(Qt.FocusReason.TabFocusReason)
    for _ in range(int(hands.random.integers(1, 4))):
        hands.key(hands.one_of(_KEYS), hands.one_of(_HELD))


def in_numbers(hands):
    panel = shown_panel(hands, hands.one_of(("inspector", "inspector", "timeline")))
    fields = [field for field in panel.findChildren(NumberField) if field.isVisible()]
    if not fields:
        return
    field, way = hands.one_of(fields), hands.one_of(("type", "type", "keys", "wheel", "drag"))
    middle = field.rect().center()
    if way == "type":
        hands.double_click(field, middle)
        hands.key(_Key.Key_A, CONTROL)
        hands.type(hands.one_of(_TEXTS))
        hands.key(hands.one_of((_Key.Key_Return, _Key.Key_Tab, _Key.Key_Escape)))
    elif way == "keys":
        field.setFocus(Qt.FocusReason.TabFocusReason)
        hands.key(hands.one_of((_Key.Key_Up, _Key.Key_Down, _Key.Key_PageDown)))
    elif way == "wheel":
        field.setFocus(Qt.FocusReason.TabFocusReason)
        hands.wheel(field, middle, hands.one_of((-2, -1, 1, 2)))
    else:
        hands.drag(field, middle, middle + QPoint(int(hands.number(-60, 60)), 0))


def in_lists(hands):
    """Choose in a drop-down list of the inspector or of the bar above the panels."""
    place = hands.window.setup_bar
    if hands.chance(0.6):
        place = shown_panel(hands, "inspector")
    fields = [
        combo_box
        for combo_box in place.findChildren(QComboBox)
        if combo_box.isVisible()
        and combo_box.isEnabled()
        and (combo_box.objectName() != "limb" or hands.chance(0.3))
    ]
    if fields:
        hands.one_of(fields).setFocus(Qt.FocusReason.TabFocusReason)
        keys = (_Key.Key_Up, _Key.Key_Down, _Key.Key_Down, _Key.Key_Home, _Key.Key_End)
        hands.key(hands.one_of(keys))


def on_buttons(hands):
    """Click on any button in sight."""
    panel = shown_panel(
        hands, hands.one_of(("inspector", "timeline", "clip_editor", "skin", "library"))
    )
    buttons = [
        button
        for button in panel.findChildren(QAbstractButton)
        if button.isVisible() and button.isEnabled()
    ]
    if buttons:
        hands.click(hands.one_of(buttons))
        hands.choose_of_popup()


def in_rows(hands):
    """Choose a preset."""
    rows = shown_panel(hands, "library").findChild(QAbstractItemView, "preset_rows")
    count = rows.model().rowCount()
    if not count:
        return
    index = rows.model().index(int(hands.random.integers(count)), 0)
    rows.scrollTo(index)
    at = rows.visualRect(index).center()
    if hands.chance(0.5):
        hands.double_click(rows, at)
    else:
        hands.click(rows, at)


def on_docks(hands):
    dock = hands.window.docks[hands.one_of(hands.window.docks)]
    way = hands.one_of(("show", "hide", "float", "dock"))
    if way in ("show", "hide"):
        dock.setVisible(way == "show")
    else:
        dock.setFloating(way == "float")
    hands.done.append((way, dock.objectName()))


def on_window(hands):
    hands.window.resize(*hands.one_of(((1366, 728), (1024, 700), (1000, 640), (900, 600))))


def in_pages(hands):
    """Open a page, type and press something there, and close it or agree to it."""
    name = hands.one_of(("find_action", "make_motion", "make_motion", "save_to_library"))
    do(hands, name)
    page = next(
        (dialog for dialog in hands.window.findChildren(QDialog) if dialog.isVisible()), None
    )
    if page is None:
        return
    if name == "make_motion":
        _make_motion(hands, page)
        return
    if (line := page.findChild(QLineEdit)) is not None:
        line.setFocus(Qt.FocusReason.TabFocusReason)
        hands.type(hands.one_of(("mute", "axes", "dark", "tap", "kept", "x", "soft, short")))
    hands.key(hands.one_of((_Key.Key_Return, _Key.Key_Escape)))


def _make_motion(hands, page):
    for _ in range(int(hands.random.integers(1, 5))):
        hands.click(page.hand, page.hand.site_centre(int(hands.random.integers(1, 21))))
    numbers = [field for field in page.findChildren(NumberField) if field.isVisible()]
    lists = [combo_box for combo_box in page.findChildren(QComboBox) if combo_box.isVisible()]
    if lists:
        hands.one_of(lists).setFocus(Qt.FocusReason.TabFocusReason)
        hands.key(_Key.Key_Down)
    if numbers:
        field = hands.one_of(numbers)
        hands.double_click(field, field.rect().center())
        hands.type(hands.one_of(_TEXTS))
        hands.key(_Key.Key_Return)
    button = hands.one_of(("add_motion", "add_motion", "cancel_motion"))
    hands.click(page.findChild(QAbstractButton, button))


def import_recording(hands):
    """Import a recording; the page reads it in another process."""
    hands.window.do("import_recording")
    for page in hands.window.imports.pages:
        hands.wait(lambda page=page: page.ready or page.preview.text)
        if page.ready and hands.chance(0.8):
            page.accept()
        else:
            page.reject()
    QApplication.processEvents()
