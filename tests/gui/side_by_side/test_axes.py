"""One design along each axis: one scale, the numbers of the map, free while hidden."""

from dataclasses import replace

import pytest
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest

from skinsource.design.design import Design, track
from skinsource.design.panel_settings import with_settings
from skinsource.signals.map_range import map_range_db
from skinsource_gui.panels.side_by_side.settings import SideBySideSettings
from tests.core.own_limbs.lab_bench import installed
from tests.gui.side_by_side.side_by_side_bench import point_at, shown

OWN = {"axis_levels_db", "axis_surface_levels_db", "axis_above_noise_db"}


def choose(window, of, **changes):
    view = replace(window.document.view, **changes)
    window.document.look(with_settings(view, "side_by_side", SideBySideSettings(of=of)))


@pytest.fixture
def panel(window, settle):
    choose(window, "axes")
    window.docks["side_by_side"].bring_forward()
    settle()
    return window.panel("side_by_side")


def test_each_axis_has_the_numbers_that_the_map_has_when_it_is_chosen(window, panel, qtbot, settle):
    cells = shown(panel, qtbot, 3)
    assert [cell.headings for cell in cells] == [(f"Along {axis}", axis) for axis in "xyz"]
    loudest = max(float(cell.values_db.max()) for cell in cells)
    assert {cell.scale.range_db for cell in cells} == {map_range_db(loudest)}
    assert panel.maps.content.common_scale is not None
    assert panel.maps.content.about == "RMS along each axis of the sensors · whole record"
    assert not panel.bar.shown.isVisible()
    assert not panel.bar.limbs.isVisible()
    assert not panel.bar.file.isVisible()
    values = {cell.headings[1]: cell.values_db for cell in cells}
    skin = window.panel("skin")
    for axis in "zyx":
        choose(window, "axes", axes=axis)
        settle()
        for cell in shown(panel, qtbot, 3):
            assert cell.values_db == pytest.approx(values[cell.headings[1]], abs=1e-9)
        on_map = skin.map.content.values
        assert on_map == pytest.approx(values[axis], abs=1e-9)


def test_pointer_selection_and_copy_are_those_of_all_maps(window, panel, qtbot):
    cells = shown(panel, qtbot, 3)
    at = point_at(panel.maps, 1, 23)
    assert panel.maps.output == 23
    for cell in cells:
        assert f"{cell.values_db[22]:.1f}".replace("-", "−") in panel.text_label.text
    QTest.mouseClick(panel.maps, Qt.MouseButton.LeftButton, pos=at)
    assert window.document.view.outputs == (23,)
    assert panel.maps.content.outputs == (23,)


def test_it_follows_edits_and_says_silence_and_what_cannot_be(window, panel, qtbot, user_data):
    before = [cell.values_db for cell in shown(panel, qtbot, 3)]
    document = window.document
    document.edit("Louder", document.design.with_input(0, amplitude=3.0))
    qtbot.waitUntil(
        lambda: (panel.maps.content.cells[0].values_db > before[0] + 9.0).all(), timeout=10_000
    )
    for cell, values in zip(shown(panel, qtbot, 3), before, strict=True):
        assert cell.values_db - values == pytest.approx(9.542425094, abs=1e-6)
    window.do("clear_inputs")
    qtbot.waitUntil(lambda: panel.maps.content.message.startswith("Silent"), timeout=10_000)
    installed(axes="z")
    window.limbs.look()
    document.edit("Lab", Design(limb="lab-1", inputs=(track(3),)))
    choose(window, "axes", axes="z", outputs=())
    [only] = shown(panel, qtbot, 1)
    assert only.heading == "Along z"


def test_only_who_looks_at_axes_pays_for_them(window, panel, qtbot, settle, monkeypatch):
    shown(panel, qtbot, 3)
    asked = []
    ask = window.engine.request
    monkeypatch.setattr(
        window.engine,
        "request",
        lambda request: (asked.append(request), ask(request)),
    )
    document = window.document
    amplitudes = iter((2.0, 3.0, 4.0))

    def quantities_of_an_edit():
        asked.clear()
        document.edit("Louder", document.design.with_input(0, amplitude=next(amplitudes)))
        settle()
        return frozenset().union(*(request.wanted for request in asked))

    assert quantities_of_an_edit() >= OWN
    # In one slot: no limb or snapshot is predicted beside the window.
    assert {request.slot.name for request in asked} == {"A"}
    choose(window, "limbs")
    shown(panel, qtbot, 4)
    assert not quantities_of_an_edit() & OWN
    choose(window, "axes")
    shown(panel, qtbot, 3)
    window.docks["side_by_side"].toggleViewAction().trigger()
    settle()
    assert not quantities_of_an_edit() & OWN
