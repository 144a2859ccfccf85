"""Chapters of the walkthrough: outputs, plots, the map, and what is shown."""

from dataclasses import replace
from functools import partial
from pathlib import Path

from driver import CONTROL, SHIFT, Driver
from PySide6.QtCore import QPoint, Qt

from skinsource.design.panel_settings import settings_of
from skinsource.limbs.catalog import available_limbs
from skinsource_gui.panels.skin.settings import SkinSettings
from skinsource_gui.panels.spectra.panel import SpectraSettings

KEY = Qt.Key
of_skin = partial(settings_of, panel="skin", kind=SkinSettings)
of_spectra = partial(settings_of, panel="spectra", kind=SpectraSettings)


def select_outputs(you: Driver, _: Path) -> None:
    """Click, shift, rubber band, keyboard, volar ones."""
    document, skin = you.window.document, you.window.panel("skin").map
    you.click(skin, skin.stage.place_of(35).toPoint())
    you.click(skin, skin.stage.place_of(61).toPoint(), SHIFT)
    you.expect(document.view.outputs == (35, 61), "click selects, shift-click adds a volar one")
    you.hover(skin, skin.stage.place_of(61).toPoint())
    you.picture("35 and 61 by click")
    corner = skin.stage.place_of(29).toPoint()
    you.drag(skin, corner + QPoint(-30, -30), corner + QPoint(40, 60))
    you.picture("by rubber band")
    you.key(KEY.Key_Down, times=2)
    you.key(KEY.Key_Space, SHIFT)
    you.picture("one more by keyboard")
    you.key(KEY.Key_A, CONTROL)
    you.expect(len(document.view.outputs) == 66, "Ctrl+A on the map selects the dorsal ones")
    you.picture("all dorsal")
    you.key(KEY.Key_A, CONTROL | SHIFT)
    you.expect(document.view.outputs == (), "Ctrl+Shift+A selects none")
    you.picture("none")
    document.look(replace(document.view, outputs=(29, 30, 33, 52)))


def read_plots(you: Driver, _: Path) -> None:
    """Zoom, crosshair, stacked, logarithmic, delay."""
    window, document = you.window, you.window.document
    traces = you.surface("traces-plot", window.panel("traces"))
    spectra = you.surface("spectra-plot", window.panel("spectra"))
    middle = traces.rect().center()
    you.hover(traces, middle)
    you.picture("crosshair in traces")
    you.drag(traces, middle - QPoint(150, 0), middle + QPoint(20, 0))
    shown = document.view.time_range_s
    you.expect(shown is not None, "a drag zooms the traces")
    you.picture("traces zoomed")
    you.click(you.widget("remove-delay", window.panel("traces")))
    moved = document.view.time_range_s
    you.expect(moved is not None and moved != shown, "without delay the same piece is shown")
    you.key(KEY.Key_T, CONTROL)
    you.expect(document.view.time_range_s == shown, "the menu does the same as the switch")
    you.focus(you.widget("traces-plot", window.panel("traces")))
    you.key(KEY.Key_Right, SHIFT)
    you.key(KEY.Key_0)
    you.picture("traces keyboard crosshair")
    you.expect(document.view.time_range_s is None, "0 shows everything")
    you.key(KEY.Key_Escape)
    you.click(you.widget("stacked", window.panel("traces")))
    you.click(you.widget("stacked", window.panel("spectra")))
    you.click(you.widget("log-frequency", window.panel("spectra")))
    you.picture("stacked and logarithmic")
    you.click(you.widget("log-magnitude", window.panel("spectra")))
    you.wheel(spectra, 5, modifiers=CONTROL)
    you.picture("spectra linear and zoomed")
    you.expect(
        of_spectra(document.view).frequency_range_hz is not None,
        "Ctrl and wheel zooms",
    )
    you.double_click(spectra)
    for panel in (window.panel("traces"), window.panel("spectra")):
        you.click(you.widget("overlaid", panel))
    you.focus(you.widget("overlaid", window.panel("spectra")))
    you.picture("focus on a checked button")


def colour_the_map(you: Driver, _: Path) -> None:
    """Range of the colours; sensors; styles."""
    window, document = you.window, you.window.document
    high = you.widget("range_high", window.panel("skin"))
    you.drag(high, high.rect().center(), high.rect().center() + QPoint(0, 60))
    you.expect(
        of_skin(document.view).map_range_db is not None,
        "a handle sets the range",
    )
    you.picture("range dragged")
    field = you.widget("range_low_field", window.panel("skin"))
    you.double_click(field)
    you.picture("typing a level")
    you.key(KEY.Key_A, CONTROL)
    you.type("-45,5")
    you.key(KEY.Key_Return)
    low = of_skin(document.view).map_range_db[0]
    you.expect(low == -45.5, f"-45,5 is understood, not {low}")
    steps = document.undo_stack.index()
    you.key(KEY.Key_Z, CONTROL)
    you.expect(document.undo_stack.index() == steps - 1, "Ctrl+Z in a level at rest undoes")
    you.key(KEY.Key_Y, CONTROL)
    you.picture("a level typed")
    you.click(you.widget("range_auto", window.panel("skin")))
    you.expect(
        of_skin(document.view).map_range_db is None,
        "Auto gives the range back",
    )
    you.click(you.widget("map_sensors_shown", window.panel("skin")))
    you.picture("no sensors")
    you.click(you.widget("map_sensors_only", window.panel("skin")))
    you.picture("sensors only")
    you.click(you.widget("map_interpolated", window.panel("skin")))
    you.click(you.widget("map_sensors_shown", window.panel("skin")))
    you.click(you.widget("map_fit_hand", window.panel("skin")))
    you.picture("the hand alone")
    you.click(you.widget("map_fit_all", window.panel("skin")))


def change_setup(you: Driver, _: Path) -> None:
    """Axes, method, scaling, limb, by keyboard."""
    window, document = you.window, you.window.document
    for name, letters in (("method", "Sum"), ("scaling", "Equal")):
        you.focus(you.widget(name, window.setup_bar))
        you.type(letters)
        you.picture(f"{name} {letters}")
    you.focus(you.widget("axes", window.setup_bar))
    you.key(KEY.Key_Home)
    you.picture("a single axis")
    you.expect(document.view.axes == "x", "Home chooses the first axis")
    unit = you.widget("amplitude_field", window.panel("inspector")).spec.unit
    you.expect(unit == "×", "the unit of the amplitude follows the scaling")
    you.focus(you.widget("limb", window.setup_bar))
    you.key(KEY.Key_End)
    you.expect(document.design.limb == "synthetic-4", "End chooses the last limb")
    you.picture("another limb")
    you.key(KEY.Key_Z, CONTROL, times=2)
    missing = replace(document.design, limb="measured-4")
    if missing.limb not in available_limbs():
        document.edit("Change limb", missing)
        you.picture("a limb that is not installed")
        you.focus(you.widget("limb", window.setup_bar))
        you.key(KEY.Key_End)
        you.expect(window.notice.text == "", "another limb ends the trouble")
        you.picture("and another that is")
        document.undo_stack.setIndex(document.undo_stack.index() - 2)
