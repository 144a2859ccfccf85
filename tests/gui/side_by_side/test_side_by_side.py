"""Maps side by side: the same numbers as alone, one scale, one pointer, no cost while hidden."""

from dataclasses import replace

import numpy as np
import pytest
from PySide6.QtCore import QEvent, QRectF, Qt
from PySide6.QtGui import QGuiApplication, QImage, QPainter
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication

from skinsource.design.comparing import Snapshot, scale_end_db
from skinsource.design.design import Design, track
from skinsource.design.panel_settings import with_settings
from skinsource.engine.evaluation import evaluate
from skinsource.signals.map_range import map_range_db
from skinsource_gui.panels.side_by_side.content import (
    Cells,
    snapshot_names,
)
from skinsource_gui.panels.skin.settings import SkinSettings
from skinsource_gui.plots.small_map import paint_small_map, tick_text
from skinsource_gui.qt.theme import LIGHT
from skinsource_gui.state.compared import Compared
from tests.gui.side_by_side.side_by_side_bench import choose, point_at, shown

LIMBS = tuple(f"synthetic-{k}" for k in (1, 2, 3, 4))


def levels(window, limb):
    design = replace(window.document.design, limb=limb)
    return evaluate(design, "output_levels_db", view=window.document.view)["output_levels_db"]


def ring(maps, index, output):
    """Pixels around an output in one of the maps, as they are painted."""
    image = maps.grab().toImage()
    x, y = (round(coordinate) for coordinate in maps.visible_maps.points_of(index)[output - 1])
    return [image.pixel(x + dx, y + dy) for dx in range(-9, 10) for dy in range(-9, 10)]


def test_four_limbs_have_their_own_levels_one_scale_one_pointer_and_one_selection(
    window, panel, qtbot
):
    cells = shown(panel, qtbot, 4)
    expected = [levels(window, limb) for limb in LIMBS]
    for cell, values in zip(cells, expected, strict=True):
        assert cell.values_db == pytest.approx(values, abs=1e-9)
        assert cell.scale.range_db == map_range_db(np.max(expected))
        assert cell.synthetic
    assert [cell.heading for cell in cells][1] == "Synthetic 2 (165 mm)"
    maps, output = panel.maps, 23
    before = [ring(maps, k, output) for k in range(4)]
    at = point_at(maps, 2, output)
    assert maps.output == output
    assert all(ring(maps, k, output) != before[k] for k in range(4))
    for values in expected:
        assert f"{values[output - 1]:.1f}".replace("-", "−") in panel.text_label.text
    assert panel.text_label.text.startswith("Output 23")
    QTest.mouseClick(maps, Qt.MouseButton.LeftButton, pos=at)
    assert window.document.view.outputs == (output,)
    QApplication.sendEvent(maps, QEvent(QEvent.Type.Leave))
    assert all(ring(maps, k, output) != before[k] for k in range(4))
    maps.setFocus()
    QTest.keyClick(maps, Qt.Key.Key_Down)
    QTest.keyClick(maps, Qt.Key.Key_Return, Qt.KeyboardModifier.ShiftModifier)
    chosen = window.document.view.outputs
    assert len(chosen) == 2
    points = maps.visible_maps.points_of(2)
    assert points[chosen[1] - 1][1] > points[output - 1][1]
    panel.copy.click()
    copied = QGuiApplication.clipboard().text().splitlines()
    rows = [line for line in copied if not line.startswith("# ")]
    assert len(rows) == 73
    assert float(rows[23].split("\t")[2]) == pytest.approx(expected[1][22])


def test_differences_and_mean_and_spread_are_those_of_the_levels(window, panel, qtbot):
    expected = np.array([levels(window, limb) for limb in LIMBS])
    choose(window, shown="difference")
    cells = shown(panel, qtbot, 3)
    for cell, values in zip(cells, expected[1:], strict=True):
        assert cell.heading.endswith("minus Synthetic 1 (175 mm)")
        assert cell.values_db == pytest.approx(values - expected[0], abs=1e-9)
        field = cell.small.field_levels_db
        assert np.nanmax(np.abs(field)) <= np.abs(values - expected[0]).max() + 1e-9
        assert cell.scale.range_db[0] == -cell.scale.range_db[1]
        differences = np.array(expected[1:]) - expected[0]
        assert cell.scale.range_db[1] == scale_end_db(differences)
        assert cell.scale.reached_db == pytest.approx((differences.min(), differences.max()))
    choose(window, shown="mean")
    mean, spread = shown(panel, qtbot, 2)
    assert mean.values_db == pytest.approx(expected.mean(axis=0), abs=1e-9)
    assert spread.values_db == pytest.approx(expected.std(axis=0, ddof=1), abs=1e-9)
    of_whom = "of 4: Synthetic 1, Synthetic 2, Synthetic 3, Synthetic 4"
    assert mean.headings == (f"Mean {of_whom}", "Mean of 4", "Mean")
    assert spread.heading == f"Standard deviation {of_whom}"
    choose(window, limbs="synthetic-3 synthetic-1", shown="difference")
    [only] = shown(panel, qtbot, 1)
    # The limb in the window is what the others are compared with, wherever it stands.
    assert only.values_db == pytest.approx(expected[2] - expected[0], abs=1e-9)


def test_it_costs_nothing_while_hidden_and_follows_edits_while_seen(
    window, panel, qtbot, settle, monkeypatch
):
    graphs = window.engine._graphs
    shown(panel, qtbot, 4)
    # The limb in the window is predicted once, for the window.
    assert {slot.name for slot in graphs if "limb" in slot.name} == {
        f"limb {limb}" for limb in LIMBS[1:]
    }
    design = window.document.design.with_input(0, amplitude=3.0)
    before = [cell.values_db for cell in panel.maps.content.cells]
    window.document.edit("Louder", design)
    cells = shown(panel, qtbot, 4)
    for cell, values in zip(cells, before, strict=True):
        assert cell.values_db - values == pytest.approx(20 * np.log10(3.0), abs=1e-9)
    window.docks["side_by_side"].toggleViewAction().trigger()
    settle()
    qtbot.waitUntil(lambda: not any("limb" in slot.name for slot in graphs))
    asked = []
    ask = window.engine.request
    monkeypatch.setattr(
        window.engine,
        "request",
        lambda request: (asked.append(request.slot.name), ask(request)),
    )
    window.document.edit("Softer", design.with_input(0, amplitude=0.5))
    settle()
    assert asked == ["A"]


def test_snapshots_stand_side_by_side_as_loud_as_they_are_shown(window, panel, qtbot):
    document = window.document
    choose(window, of="snapshots")
    qtbot.waitUntil(lambda: "Store the design" in panel.maps.content.message)
    document.look(replace(document.view, levels_matched=True))
    window.do("store_snapshot_1")
    other = document.design.with_input(0, location=12, amplitude=7.0)
    document.edit("Elsewhere", other)
    window.do("store_snapshot_2")
    cells = shown(panel, qtbot, 2)
    assert [cell.heading for cell in cells] == ["Snapshot 1", "Snapshot 2"]
    loudest = [float(cell.values_db.max()) for cell in cells]
    assert loudest[0] == pytest.approx(loudest[1], abs=1e-9)
    assert np.nanmax(cells[1].small.field_levels_db) <= loudest[1] + 1e-9
    text = panel.maps.content.common_scale.text_below
    assert text.startswith("dB re 1 m/s², 2: \N{MINUS SIGN}")
    assert text.endswith(" dB, matched")
    document.look(replace(document.view, levels_matched=False))
    qtbot.waitUntil(
        lambda: panel.maps.content.cells[1].values_db.max() > loudest[0] + 5.0, timeout=5000
    )
    choose(window, shown="difference")
    [only] = shown(panel, qtbot, 1)
    assert only.heading == "Snapshot 1 minus Snapshot 2"


def test_all_of_it_is_seen_in_a_narrow_dock_whatever_it_reads(window, panel, qtbot):
    shown(panel, qtbot, 4)
    dock = window.docks["side_by_side"]
    point_at(panel.maps, 0, 23)
    QApplication.processEvents()
    assert panel.text_label.shown == panel.text_label.text
    room = dock.widget().height()
    assert panel.minimumSizeHint().height() < panel.height() <= room


def test_silence_is_said(window, panel, qtbot):
    shown(panel, qtbot, 4)
    window.do("clear_inputs")
    qtbot.waitUntil(lambda: panel.maps.content.message.startswith("Silent"), timeout=30_000)
    assert not panel.grab().isNull()


def test_a_range_that_is_fixed_on_the_skin_map_holds_for_maps_in_the_same_unit(
    window, panel, qtbot
):
    shown(panel, qtbot, 4)
    fixed = SkinSettings(map_range_db=(-60.0, -20.0))
    window.document.look(with_settings(window.document.view, "skin", fixed))

    def scales():
        return [cell.scale for cell in panel.maps.content.cells if cell.scale is not None]

    def all_fixed():
        return {scale.range_db for scale in scales()} == {(-60.0, -20.0)}

    qtbot.waitUntil(all_fixed, timeout=60_000)
    assert {scale.text_below for scale in scales()} == {"dB re 1 m/s² · range fixed"}
    choose(window, shown="mean")
    qtbot.waitUntil(lambda: len(scales()) == 2, timeout=60_000)
    mean, spread = scales()
    assert mean.range_db == (-60.0, -20.0)
    assert spread.range_db[0] == 0.0
    assert spread.text_below == "dB"


@pytest.mark.parametrize(
    ("value", "reached", "text"),
    [
        (-20.0, (-57.0, 3.0), "≤ −20"),
        (20.0, (-57.0, 3.0), "+20"),
        (20.0, (-1.0, 20.5), "≥ +20"),
        (0.0, (-57.0, 60.0), "0"),
        (-20.0, None, "−20"),
    ],
)
def test_the_ends_of_a_scale_say_what_else_has_their_colour(value, reached, text):
    assert tick_text(value, (-20.0, 20.0), reached, signed=True) == text


def test_snapshots_of_a_scene_are_told_by_what_their_titles_do_not_share():
    def stored(number, title):
        design = Design(limb="synthetic-1", title=title)
        return Compared(snapshot=Snapshot(number=number, design=design))

    tones = [stored(1, "Fig. 2B: Far · 50 Hz"), stored(2, "Fig. 2B: Far · 100 Hz")]
    first, second = snapshot_names(tones, "xyz")
    assert first == (
        "Snapshot 1 · Fig. 2B: Far · 50 Hz",
        "Snapshot 1 · 50 Hz",
        "1 · 50 Hz",
        "Snapshot 1",
        "1",
    )
    assert second[1] == "Snapshot 2 · 100 Hz"
    # What is the same throughout is said; nothing is taken from titles that share nothing.
    assert snapshot_names([tones[0], tones[0]], "xyz")[0][1] == "Snapshot 1 · 50 Hz"
    assert snapshot_names([tones[0], stored(2, "Other")], "xyz")[1] == (
        "Snapshot 2 · Other",
        "Snapshot 2",
        "2",
    )
    assert snapshot_names([stored(1, "")], "xyz") == [("Snapshot 1", "1")]


DESIGN = Design(limb="synthetic-1", inputs=(track(7),))


def compared(number, noisy):
    names = ("limb_map", "limb_data", "output_levels_db", "surface", "surface_levels_db")
    values = dict(evaluate(DESIGN, *names))
    above = np.full(72, 20.0)
    above[[output - 1 for output in noisy]] = 5.9
    return Compared(
        snapshot=Snapshot(number=number, design=DESIGN), values={**values, "above_noise_db": above}
    )


def painted(small):
    image = QImage(120, 280, QImage.Format.Format_RGB32)
    image.fill(0xFFFFFF)
    painter = QPainter(image)
    paint_small_map(painter, QRectF(0, 0, 120, 280), small, None, LIGHT)
    painter.end()
    return image


def test_what_is_mostly_noise_is_hatched_on_each_map_and_on_what_is_made_of_several(qapp):
    pair = [compared(1, noisy=(3, 70)), compared(2, noisy=(70, 71))]
    names = [("one",), ("two",)]
    first, second = Cells().of_levels(pair, names)
    assert (first.small.noisy, second.small.noisy) == ((3, 70), (70, 71))
    [difference] = Cells().of_differences(pair, names, 0)
    assert difference.small.noisy == (3, 70, 71)
    assert [cell.small.noisy for cell in Cells().of_spread(pair, names, 0)] == [(3, 70, 71)] * 2
    [quiet, _] = Cells().of_levels([compared(1, noisy=()), pair[1]], names)
    assert painted(first.small) != painted(quiet.small)
