"""The range between people: the same numbers in map, figure, sweep and sidecar, where asked for."""

import json
from dataclasses import replace

import numpy as np
import pytest

import skinsource as ss
from skinsource.design.comparing import NO_RANGE, RANGE_BETWEEN_PEOPLE
from skinsource.design.design import Snapshot
from skinsource.design.panel_settings import settings_of, with_settings
from skinsource.export.stimulus_export.sidecar import sidecar_path
from skinsource_gui.panels.skin.map import numbers_text, output_readout
from skinsource_gui.panels.skin.picture import heading_of
from skinsource_gui.panels.skin.settings import PEOPLE, SkinSettings
from skinsource_gui.shell.status import shown_text
from skinsource_gui.state.compared import Compared
from tests.core.own_limbs.lab_bench import installed

LIMBS = tuple(f"synthetic-{k}" for k in (1, 2, 3, 4))
SENTENCE = f"R{RANGE_BETWEEN_PEOPLE[1:]}."


def look(window, **changes):
    view = window.document.view
    settings = replace(settings_of(view, "skin", SkinSettings), **changes)
    window.document.look(with_settings(view, "skin", settings))


@pytest.fixture
def skin(window, settle, qtbot):
    look(window, quantity=PEOPLE)
    settle()
    panel = window.panel("skin")
    qtbot.waitUntil(lambda: panel.content.values is not None and not panel.is_stale)
    return panel


def test_map_figure_sweep_and_sidecar_have_the_numbers_of_the_function(window, skin, tmp_path):
    design = window.document.design
    found = ss.people.levels(design, window.document.view, limbs=LIMBS)
    assert window.document.view.axes == ss.View().axes
    content = skin.content
    np.testing.assert_allclose(content.values, found.mean_db, atol=1e-9)
    half_db = content.quantity.half_db
    np.testing.assert_allclose(content.values + half_db, found.high_db, atol=1e-9)
    figure = ss.plot.people(design)
    fields = [axes.images[0].get_array() for axes in figure.axes[:3]]
    surface = ss.surface_operator("synthetic-1")
    for field, values in zip(fields, (found.low_db, found.mean_db, found.high_db), strict=True):
        inside = np.isfinite(surface.interpolate(values))
        np.testing.assert_allclose(field[inside], surface.interpolate(values)[inside], atol=1e-9)
    assert any(SENTENCE[:-1] in text.get_text() for text in figure.texts)
    table = ss.sweep(design, {"amplitude": [1.0, 2.0]}, people=True)
    loudest = table.column("loudest_output").astype(int) - 1
    for name, ends in (("range_low_db", found.low_db), ("range_high_db", found.high_db)):
        by_db = [0.0, 20.0 * np.log10(2.0)]
        np.testing.assert_allclose(table.column(name), ends[loudest] + by_db, atol=1e-9)
    path = tmp_path / "drive.wav"
    ss.export_stimulus(design, path, options=ss.StimulusOptions(people=True))
    about = json.loads(sidecar_path(path).read_text(encoding="utf-8"))["range_between_people"]
    assert about["people"] == list(LIMBS)
    assert about["means"] == RANGE_BETWEEN_PEOPLE
    for name in ("mean_db", "low_db", "high_db"):
        np.testing.assert_allclose(about[name], getattr(found, name), atol=1e-9)


def test_the_map_says_the_range_under_the_pointer_and_once_what_it_is(window, skin):
    content = skin.content
    value, half_db = content.values[28], content.quantity.half_db
    low, high = value - half_db, value + half_db
    text = f"{value:.1f} dB re 1 m/s²  ({low:.1f} to {high:.1f} between people)".replace("-", "−")
    assert output_readout(content, 29).endswith(f" · {text}")
    assert skin.measure.quantity.text().startswith("Mean of people")
    assert skin.measure.axes.isEnabled()
    assert skin.measure.span.isEnabled()
    said = f"±{half_db:.1f} dB at every place. {SENTENCE}"
    assert content.note.count(said) == 1
    assert content.drawn_note.count(said) == 1
    heading = heading_of(window.document.design, content.quantity, content.drawn_note)
    assert heading.title.startswith("Mean of people, RMS over the whole record")
    assert heading.details.startswith("drawn on Synthetic 1")
    head, *rows = numbers_text(content).splitlines()
    assert head.split("\t")[2:] == [f"{end}level_db_re_1_m_per_s2" for end in ("", "low_", "high_")]
    copied = [float(cell) for cell in rows[28].split("\t")[2:]]
    assert copied == pytest.approx([value, low, high], abs=1e-3)
    predicted = shown_text(window.document.design, window.document.view)
    assert predicted.startswith("Predicted acceleration, mean of people, back of the hand")


def test_nothing_is_computed_on_other_limbs_before_it_is_asked_for_nor_after(
    window, settle, requests, qtbot
):
    graphs = window.engine._graphs
    window.document.edit("Louder", window.document.design.with_input(0, amplitude=3.0))
    settle()
    assert {request.slot for request in requests} == {"A"}
    look(window, quantity=PEOPLE)
    skin = window.panel("skin")
    qtbot.waitUntil(lambda: skin.content.values is not None)
    # The limb in the window is predicted once, for the window.
    others = {f"limb {limb}" for limb in LIMBS[1:]}
    assert {slot for slot in graphs if "limb" in slot} == others
    look(window, quantity="levels")
    settle()
    qtbot.waitUntil(lambda: not any("limb" in slot for slot in graphs))
    requests.clear()
    window.document.edit("Softer", window.document.design.with_input(0, amplitude=0.5))
    settle()
    assert {request.slot for request in requests} == {"A"}
    assert skin.content.note == ""


def test_the_range_follows_edits_and_is_old_until_all_people_are_known_anew(window, skin, qtbot):
    before = skin.content.values
    design = window.document.design.with_input(0, amplitude=3.0)
    window.document.edit("Louder", design)
    qtbot.waitUntil(lambda: not skin.is_stale and skin.content.values is not before)
    np.testing.assert_allclose(skin.content.values - before, 20.0 * np.log10(3.0), atol=1e-9)
    values = {"output_levels_db": before}
    sides = [Compared(snapshot=Snapshot(design=design), values=values) for _ in LIMBS]
    half_db = skin.content.quantity.half_db
    skin.show_on_limbs([replace(sides[0], is_stale=True), *sides[1:]])
    assert skin.content.quantity.half_db == half_db
    skin.show_on_limbs(sides)
    assert skin.content.quantity.half_db == 0.0
    skin.show_on_limbs([*sides[1:], replace(sides[0], values=None)])
    assert skin.content.values is None
    skin.show_on_limbs([*sides[1:], replace(sides[0], values=None, problem="It is gone.")])
    assert skin.content.message == "It is gone."


def test_an_own_limb_has_no_range(window, skin, qtbot, user_data):
    limb = installed().name
    window.document.edit("Limb", ss.Design(limb=limb, inputs=(ss.track(1),)))
    qtbot.waitUntil(lambda: skin.content.message == NO_RANGE)
    assert not skin.needs_on_limbs
    look(window, quantity="levels")
    qtbot.waitUntil(lambda: skin.content.values is not None)
