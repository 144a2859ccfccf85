"""Compared maps: the same numbers as alone, one scale, one pointer, no cost while hidden."""

from dataclasses import replace
from itertools import product
from unittest.mock import patch

import numpy as np
import pytest
from PySide6.QtCore import QEvent, QPoint, QRectF, Qt
from PySide6.QtGui import QGuiApplication, QImage, QMouseEvent, QPainter
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication

from skinsource import Design, View, evaluate, people, track, waveforms
from skinsource.design.comparing import scale_end_db
from skinsource.design.design import Snapshot
from skinsource.design.panel_settings import with_settings
from skinsource.engine.analysis_rules import noisy_outputs_of_windows
from skinsource.signals.map_range import MAP_RANGE_DB, map_range_db
from skinsource_gui.panels.compare.content import (
    KINDS,
    of_differences,
    of_levels,
    of_spread,
    snapshot_names,
)
from skinsource_gui.panels.compare.panel import ChoicesBar
from skinsource_gui.panels.compare.settings import CompareSettings
from skinsource_gui.panels.skin.settings import SkinSettings
from skinsource_gui.plots.small_map import LevelStyle, paint_small_map, scale_of_levels, tick_text
from skinsource_gui.qt.theme import LIGHT
from skinsource_gui.state.compared import Compared
from skinsource_gui.state.engine import Purpose
from tests.core.own_limbs.lab_bench import installed
from tests.gui.compare.compare_bench import choose, point_at, shown

LIMBS = tuple(f"synthetic-{k}" for k in (1, 2, 3, 4))


@pytest.fixture
def panel(window, settle):
    choose(window, of="limbs")
    window.docks["compare"].bring_forward()
    settle()
    return window.panel("compare")


def levels(window, limb):
    design = replace(window.document.design, limb=limb)
    return evaluate(design, "output_levels_db", view=window.document.view)["output_levels_db"]


def ring(maps, index, output):
    """Pixels around an output in one of the maps, as they are painted."""
    image = maps.grab().toImage()
    x, y = (round(coordinate) for coordinate in maps.points_of(index)[output - 1])
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
    at, size = point_at(maps, 2, output), maps.size()
    assert maps.output == output
    assert all(ring(maps, k, output) != before[k] for k in range(4))
    for values in expected:
        assert f"{values[output - 1]:.1f}".replace("-", "−") in panel.text_label.whole
    assert panel.text_label.whole.startswith("Output 23")
    # Maps that move on, or lie elsewhere under the pointer, are read anew.
    with patch.object(maps, "update") as painted:
        maps.show_frame(maps.content.cells)
    painted.assert_any_call(maps.places.cells[0].value.toAlignedRect())
    content, said, none = maps.content, {panel.text_label.whole}, Qt.MouseButton.NoButton
    plain, on_screen = Qt.KeyboardModifier.NoModifier, maps.mapToGlobal(at)
    move = QMouseEvent(QEvent.Type.MouseMove, at, on_screen, none, none, plain)
    for drawn, share in ((cells[:3], 1.0), (cells[:3], 0.8), (cells, 0.8), (cells, 1.0)):
        maps.show_content(replace(content, cells=drawn))
        maps.resize(size * share)
        told = panel.text_label.whole
        maps.picker.leave()
        QApplication.sendEvent(maps, move)
        assert panel.text_label.whole == told
        said.add(told.split(":")[0])
    assert len(said) > 2
    QTest.mouseClick(maps, Qt.MouseButton.LeftButton, pos=at)
    assert window.document.view.outputs == (output,)
    QApplication.sendEvent(maps, QEvent(QEvent.Type.Leave))
    assert all(ring(maps, k, output) != before[k] for k in range(4))
    maps.setFocus()
    QTest.keyClick(maps, Qt.Key.Key_Down)
    QTest.keyClick(maps, Qt.Key.Key_Return, Qt.KeyboardModifier.ShiftModifier)
    chosen = window.document.view.outputs
    assert len(chosen) == 2
    points = maps.points_of(2)
    assert points[chosen[1] - 1][1] > points[output - 1][1]
    panel.copy.click()
    copied = QGuiApplication.clipboard().text().splitlines()
    rows = [line for line in copied if not line.startswith("# ")]
    assert len(rows) == 73
    assert float(rows[23].split("\t")[2]) == pytest.approx(expected[1][22])


def test_low_maps_show_hands_with_words_beside_them_and_a_whole_scale(window, panel, qtbot):
    shown(panel, qtbot, 4)
    maps, arm, hand = panel.maps, 47 - 1, 29 - 1
    maps.resize(940, 180)
    places = maps.places
    assert places.low
    cells = [(cell.map, cell.heading, cell.value) for cell in places.cells]
    areas = [places.scale, *(area.adjusted(1, 1, -1, -1) for parts in cells for area in parts)]
    assert all(QRectF(maps.rect()).contains(area) for area in areas)
    assert not any(one.intersects(two) for k, one in enumerate(areas) for two in areas[:k])
    assert np.isnan(maps.points_of(0)[arm]).all()
    assert places.cells[0].map.contains(*maps.points_of(0)[hand])
    maps.resize(940, 600)
    assert not maps.places.low
    assert np.isfinite(maps.points_of(0)[arm]).all()


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
    choose(window, shown="range")
    cells = shown(panel, qtbot, 3)
    found = people.levels(window.document.design, window.document.view, limbs=LIMBS)
    for cell, values in zip(cells, (found.low_db, found.mean_db, found.high_db), strict=True):
        assert cell.values_db == pytest.approx(values, abs=1e-9)
    assert [cell.heading for cell in cells] == ["Low, expected", "Mean of 4", "High, expected"]
    said = f"±{found.high_db[0] - found.mean_db[0]:.1f} dB at every place. Range between people: "
    assert panel.maps.content.about.startswith(said)
    choose(window, limbs="synthetic-3 synthetic-1", shown="difference")
    [only] = shown(panel, qtbot, 1)
    # The limb in the window is what the others are compared with, wherever it stands.
    assert only.values_db == pytest.approx(expected[2] - expected[0], abs=1e-9)


def test_limbs_follow_edits_while_seen_and_cost_nothing_while_hidden(
    window, panel, qtbot, settle, requests
):
    graphs = window.engine._graphs
    shown(panel, qtbot, 4)
    # The limb in the window is predicted once, for the window.
    others = {f"limb {limb}" for limb in LIMBS[1:]}
    assert {slot for slot in graphs if "limb" in slot} == others
    design = window.document.design.with_input(0, amplitude=3.0)
    before = [cell.values_db for cell in panel.maps.content.cells]
    window.document.edit("Louder", design)
    cells = shown(panel, qtbot, 4)
    for cell, values in zip(cells, before, strict=True):
        assert cell.values_db - values == pytest.approx(20 * np.log10(3.0), abs=1e-9)
    window.docks["compare"].toggleViewAction().trigger()
    settle()
    qtbot.waitUntil(lambda: not any("limb" in slot for slot in graphs))
    requests.clear()
    window.document.edit("Softer", design.with_input(0, amplitude=0.5))
    settle()
    assert [request.slot for request in requests] == ["A"]


def test_each_map_can_be_drawn_to_its_own_maximum(window, panel, qtbot):
    before = [cell.values_db for cell in shown(panel, qtbot, 4)]
    QTest.mouseClick(panel.bar.own_maximum, Qt.MouseButton.LeftButton)
    cells = shown(panel, qtbot, 4)
    scale = panel.maps.content.common_scale
    assert (scale.text_below, scale.range_db) == ("dB re each map's maximum", (-MAP_RANGE_DB, 0.0))
    for cell, values in zip(cells, before, strict=True):
        assert cell.values_db == pytest.approx(values - values.max(), abs=1e-12)
        assert np.nanmax(cell.small.field_levels_db) == pytest.approx(0.0, abs=1.0)
        assert cell.value_text(None).startswith(f"max {values.max():.1f} dB".replace("-", "−"))
    point_at(panel.maps, 1, 23)
    assert panel.text_label.whole.endswith(" dB re each map's maximum")
    panel.copy.click()
    head, *rows = QGuiApplication.clipboard().text().splitlines()
    for column, values in enumerate(before, 1):
        title, below = head.split("\t")[column], float(rows[22].split("\t")[column])
        assert below == pytest.approx(values[22] - values.max())
        assert float(title.split(" of ")[1].split(" dB")[0]) == pytest.approx(values.max())
    # Only levels have maxima of their own; of axes these are shown whatever was chosen of others.
    for what, n in (("difference", 3), ("mean", 2)):
        choose(window, shown=what)
        assert all(cell.maximum_db is None for cell in shown(panel, qtbot, n))
        assert not panel.bar.own_maximum.isVisible()
    choose(window, of="axes")
    assert shown(panel, qtbot, 3)[0].maximum_db is not None


def test_the_choosers_stay_in_their_place_whatever_is_chosen(qtbot):
    bar, places = ChoicesBar("compare", None), set()
    qtbot.addWidget(bar)
    bar.resize(900, 60)
    kinds = "snapshots", "limbs", "axes", "frequencies", "windows"
    for of, what in product(kinds, ("levels", "motion")):
        view = with_settings(View(), "compare", CompareSettings(of=of, shown=what))
        bar.show_state(Design(limb="synthetic-1"), view)
        bar.grab()
        places.add((bar.of.geometry().getRect(), bar.shown.geometry().getRect()))
        assert not bar.shown.isHidden()
    assert len(places) == 1


def test_each_axis_has_the_levels_that_the_skin_map_has_along_it(window, panel, qtbot, settle):
    choose(window, of="axes")
    cells = shown(panel, qtbot, 3)
    assert [cell.headings for cell in cells] == [(f"Along {axis}", axis) for axis in "xyz"]
    assert panel.maps.content.common_scale is not None
    assert panel.maps.content.about == "RMS along each axis of the sensors · whole record"
    assert panel.bar.shown.count() == 2
    hidden = panel.bar.limbs, panel.bar.file, panel.cards[1]
    assert not any(part.isVisible() for part in hidden)
    at = point_at(panel.maps, 1, 23)
    QTest.mouseClick(panel.maps, Qt.MouseButton.LeftButton, pos=at)
    assert window.document.view.outputs == (23,)
    values = {cell.headings[1]: cell.values_db for cell in cells}
    for axis in "zyx":
        window.document.look(replace(window.document.view, axes=axis))
        settle()
        for cell in shown(panel, qtbot, 3):
            assert cell.values_db == pytest.approx(values[cell.headings[1]], abs=1e-9)
        assert window.panel("skin").map.content.values == pytest.approx(values[axis], abs=1e-9)
    panel.bar.shown.edited.emit("motion", None)
    assert {cell.scale.unit for cell in shown(panel, qtbot, 3)} == {"m/s²"}
    # Of axes there is no difference.
    choose(window, shown="difference")
    assert panel.bar.shown.value == "levels"
    assert not panel.moves


def test_a_frequency_that_is_typed_twice_is_shown_once(window, panel, qtbot):
    choose(window, of="frequencies")
    panel.bar.frequencies.line.setPlainText("50, 150, 50")
    assert [cell.heading for cell in shown(panel, qtbot, 3)] == ["50 Hz", "100 Hz", "150 Hz"]
    assert panel.bar.frequencies.line.text() == "50, 150, 50"


def test_two_to_four_limbs_are_chosen_from_those_there_are(window, panel, qtbot):
    shown(panel, qtbot, 4)

    def entries():
        panel.bar.limbs.fill()
        actions = panel.bar.limbs.menu_of_limbs.actions()
        return {action.text(): action for action in actions if action.text()}

    offered = entries()
    assert offered["Related limbs"].isChecked()
    offered["Synthetic 2 (165 mm)"].trigger()
    assert len(shown(panel, qtbot, 3)) == 3
    entries()["Synthetic 4 (165 mm)"].trigger()
    cells = shown(panel, qtbot, 2)
    assert [cell.limb for cell in cells] == ["synthetic-1", "synthetic-3"]
    offered = entries()
    assert not offered["Synthetic 3 (185 mm)"].isEnabled()
    assert offered["Synthetic 4 (165 mm)"].isEnabled()
    assert not offered["Related limbs"].isChecked()
    offered["Related limbs"].trigger()
    shown(panel, qtbot, 4)
    # The menu stays open from tick to tick, by mouse and by key.
    menu = panel.bar.limbs.menu_of_limbs
    menu.popup(QPoint())
    place = menu.actionGeometry(menu.actions()[3]).center()
    QTest.mouseClick(menu, Qt.MouseButton.LeftButton, pos=place)
    shown(panel, qtbot, 3)
    QTest.keyClick(menu, Qt.Key.Key_Down)
    QTest.keyClick(menu, Qt.Key.Key_Return)
    cells = shown(panel, qtbot, 2)
    assert [cell.limb for cell in cells] == ["synthetic-1", "synthetic-4"]
    assert menu.isVisible()
    menu.close()


def test_a_limb_that_is_missing_laid_out_otherwise_or_too_large_says_so(
    window, panel, qtbot, settle, monkeypatch, requests, user_data
):
    choose(window, limbs="synthetic-1 synthetic-2 lab-1")
    shown(panel, qtbot, 2)
    assert "No limb is called 'lab-1'" in panel.maps.content.cells[2].text
    document = window.document
    document.edit("a", document.design.with_input(0, location=3).adding(track(2)))
    installed()
    window.limbs.look()
    cells = shown(panel, qtbot, 3)
    assert cells[2].heading == "Lab 1 (x, z)"
    assert cells[2].values_db.shape == (31,)
    choose(window, shown="difference")
    shown(panel, qtbot, 1)
    assert "different places" in panel.maps.content.cells[1].text
    choose(window, shown="mean")
    assert shown(panel, qtbot, 2)[0].heading == "Mean of 2 of 3: Synthetic 1, Synthetic 2"
    monkeypatch.setattr("skinsource.limbs.limb.LIVE_INPUTS", 5)
    monkeypatch.setattr("skinsource_gui.state.engine.LIVE_INPUTS", 5)
    requests.clear()
    choose(window, shown="levels")
    document.edit("b", document.design.with_input(0, amplitude=0.3))
    settle()
    # Published limbs are larger than that as well.
    said = "live results are possible up to 5"
    qtbot.waitUntil(lambda: all(said in cell.text for cell in panel.maps.content.cells))
    # Lamps and error of what was shown before may still be on their way.
    quantities = [request.wanted for request in requests if request.purpose == Purpose.SHOW]
    # What clips play is drawn all the same, and runs through no limb.
    assert not any("output_levels_db" in names or "vibration" in names for names in quantities)


def test_a_snapshot_on_a_limb_without_the_axes_of_the_view_shows_those_it_has(
    window, panel, qtbot, user_data
):
    installed(axes="xz")
    window.limbs.look()
    document = window.document
    on_lab = Design(limb="lab-1", inputs=(track(3),))
    choose(window, of="snapshots")
    document.edit("lab", on_lab)
    window.do("store_snapshot_1")
    document.edit("back", Design(limb="synthetic-1", inputs=(track(7),)))
    document.look(replace(document.view, axes="y"))
    [lab] = [cell for cell in shown(panel, qtbot, 2) if cell.limb == "lab-1"]
    assert lab.heading.startswith("Snapshot 1 (x, z) on ")
    assert " s long; differences and means over " in panel.maps.content.about
    view = View(axes="xz", method=document.view.method)
    expected = evaluate(on_lab, "output_levels_db", view=view)["output_levels_db"]
    assert lab.values_db == pytest.approx(expected, abs=1e-9)


@pytest.mark.parametrize(("axes", "viewed"), [("xz", "y"), ("xy", "z"), ("xy", "xy")])
def test_limbs_that_were_measured_along_different_axes_move_beside_each_other(
    window, panel, qtbot, user_data, axes, viewed
):
    installed(axes=axes)
    window.limbs.look()
    names, document = ("synthetic-1", "lab-1"), window.document
    designs = [Design(limb=name, inputs=(track(3, waveforms.Tap()),)) for name in names]
    document.edit("", designs[viewed == axes])
    stored = tuple(Snapshot(number=k, design=each) for k, each in enumerate(designs, 1))
    document.look(replace(document.view, axes=viewed, snapshots=stored))
    vectors = [evaluate(each, "moving_vector")["moving_vector"].signals for each in designs]
    # Lengths of vectors where one of them does not move along a single axis of the view or z.
    largest = [np.linalg.norm(each, axis=1).max() for each in vectors]
    if axes == "xz":
        largest = [np.abs(each[:, 1]).max() for each in vectors]
    for of in ("snapshots", "limbs"):
        choose(window, of=of, shown="motion", limbs=" ".join(names))
        cells = shown(panel, qtbot, 2)
        assert [cell.reaches[-1] for cell in cells] == [f"{each:.2g} m/s²" for each in largest]
        assert cells[0].scale.signed is (axes == "xz")


def test_a_range_that_is_fixed_on_the_skin_map_holds_for_maps_in_the_same_unit(
    window, panel, qtbot
):
    shown(panel, qtbot, 4)
    fixed = SkinSettings(map_range_db=(-60.0, -20.0))
    window.document.look(with_settings(window.document.view, "skin", fixed))

    def scales():
        return [cell.scale for cell in panel.maps.content.cells if cell.scale is not None]

    ends = {(-60.0, -20.0)}
    qtbot.waitUntil(lambda: {scale.range_db for scale in scales()} == ends, timeout=60_000)
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


@pytest.mark.parametrize(("fixed_db", "text"), [((-60.0, -20.0), "≥ −20"), ((-60.0, 0.0), "0")])
def test_levels_above_a_fixed_range_are_told_at_its_end(fixed_db, text):
    scale = scale_of_levels(np.array([-70.0, -10.0]), LevelStyle(map_range_db=fixed_db))
    assert tick_text(fixed_db[1], scale.range_db, scale.reached_db) == text


def test_snapshots_of_a_scene_are_told_by_what_their_titles_do_not_share():
    def stored(number, title):
        design = Design(limb="synthetic-1", title=title)
        return Compared(snapshot=Snapshot(number=number, design=design))

    tones = [stored(1, "Fig. 2B: Far · 50 Hz"), stored(2, "Fig. 2B: Far · 100 Hz")]
    first, second = snapshot_names(tones, "xyz")
    assert first == ("Snapshot 1 · 50 Hz", "1 · 50 Hz", "1 · 50 Hz", "Snapshot 1", "1")
    assert second[0] == "Snapshot 2 · 100 Hz"
    # One with a title of its own takes nothing from the others, nor gives them the figure's.
    named = Compared(snapshot=replace(tones[0].snapshot, title="Soft"))
    of_three = snapshot_names([named, *tones[1:], stored(3, "Fig. 2B: Far · Both")], "xyz")
    assert [names[0][13:] for names in of_three] == ["Soft", "100 Hz", "Both"]
    # A title of several is that of none; nothing is taken from titles that share nothing.
    same = snapshot_names([tones[0], stored(3, "Fig. 2B: Far · 50 Hz"), tones[1]], "xyz")
    assert [names[0] for names in same] == ["Snapshot 1", "Snapshot 3", second[0]]
    other = snapshot_names([tones[0], stored(2, "Other")], "xyz")[1]
    assert list(dict.fromkeys(other)) == ["Snapshot 2 · Other", "2 · Other", "Snapshot 2", "2"]
    assert snapshot_names([stored(1, "")], "xyz") == [("Snapshot 1", "1")]


DESIGN = Design(limb="synthetic-1", inputs=(track(7),))


def compared(number, noisy):
    names = ("limb_map", "limb_data", "output_levels_db", "surface", "surface_levels_db")
    values = {**evaluate(DESIGN, *names), "above_noise_db": np.full(72, 20.0)}
    values["above_noise_db"][[output - 1 for output in noisy]] = 5.9
    return Compared(snapshot=Snapshot(number=number, design=DESIGN), values=values)


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
    first, second = of_levels(pair, names)
    assert (first.small.noisy, second.small.noisy) == ((3, 70), (70, 71))
    [difference] = of_differences(pair, names, 0, "loudest")
    assert difference.small.noisy == (3, 70, 71)
    assert [cell.small.noisy for cell in of_spread(pair, names, 0, "loudest")] == [(3, 70, 71)] * 2
    [quiet, _] = of_levels([compared(1, noisy=()), pair[1]], names)
    assert painted(first.small) != painted(quiet.small)


def test_each_time_window_hatches_its_own_noise_and_says_what_its_levels_are_over(qapp):
    kind = KINDS["windows"]
    results = evaluate(DESIGN, "rms_of_windows", *kind.needs)
    # Of a synthetic limb there is none.
    assert results["noise_rms_of_windows"] is None
    assert {cell.small.noisy for cell in of_windows(results)} == {()}
    rms = results["rms_of_windows"]
    noise = 0.1 * rms
    noise[1, 4], noise[2, [5, 70]] = 0.51 * rms[1, 4], 0.51 * rms[2, [5, 70]]
    hatched = [cell.small.noisy for cell in of_windows({**results, "noise_rms_of_windows": noise})]
    assert hatched[1:3] == [(5,), (6, 71)]
    # As on the picture of the windows.
    assert hatched == list(noisy_outputs_of_windows(rms, noise))
    about = kind.about(kind.sides(DESIGN, results), DESIGN, View())
    assert about.startswith("RMS of x, y, z, principal axis in windows · mean distance")


def test_of_more_windows_than_are_seen_it_says_that_these_are_the_first(qapp):
    kind, view = KINDS["windows"], View(windows_cut="count", window_count=9)
    sides = kind.sides(DESIGN, evaluate(DESIGN, *kind.needs, view=view))
    assert "in windows · the first 6 of 9 · mean distance" in kind.about(sides, DESIGN, view)


def of_windows(results):
    kind = KINDS["windows"]
    sides = kind.sides(DESIGN, results)
    return of_levels(sides, kind.names(sides, View()))
