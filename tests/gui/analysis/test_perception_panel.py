"""Levels above threshold: in their panel and on the map."""

from dataclasses import replace

import numpy as np
import pytest

from skinsource.design.edits.edit import Edit
from skinsource.design.panel_settings import settings_of, with_settings
from skinsource.engine.analysis_rules import Sensation
from skinsource.perception.thresholds import LIMITS, PerceptionSettings
from skinsource.signals.analysis.wave_speed import travelling_wave
from skinsource_gui.panels.analysis.perception import (
    contact_list,
    contact_table,
    contact_text,
    rows,
    table_text,
)
from skinsource_gui.panels.analysis.wave import wave_text
from skinsource_gui.panels.skin.settings import SkinSettings
from tests.gui.analysis.analysis_bench import analysis, copied

OUTPUTS = (29, 33, 57)


def test_the_panel_shows_levels_limits_and_the_contact(window, settle, tmp_path):
    document = window.document
    document.look(replace(document.view, outputs=OUTPUTS))
    analysis(window, "perception")
    settle()
    panel = window.panel("analysis").view
    assert panel.table.model().rowCount() == 3
    assert panel.limits.text() == f"{LIMITS} Only 25 to 600 Hz counts."
    assert "not perception" in panel.contact.text()
    assert "place 7" in panel.contact.text()
    numbers, contacts = copied(window).split("\n\n")
    lines = numbers.splitlines()
    assert [line.split("\t")[0] for line in lines] == ["output", "29", "33", "57"]
    labels = [line.split("\t")[0] for line in contacts.splitlines() if line[0] != "#"]
    assert labels == ["place", "7"]
    path = tmp_path / "mine.csv"
    path.write_text("frequency_hz,threshold_m_per_s2\n25,0.1\n600,0.1\n")
    panel.import_thresholds(path)
    settle()
    held = settings_of(document.view, "perception", PerceptionSettings)
    assert held.thresholds == ((25.0, 0.1), (600.0, 0.1))
    assert panel.table.model().columnCount() == 3
    assert "your table" in panel.limits.text()
    panel.model.click()
    settle()
    assert panel.table.model().columnCount() == 5


@pytest.mark.parametrize("style", ["interpolated", "sensors"])
def test_the_map_shows_levels_above_threshold_with_their_limits(window, settle, style):
    document, skin = window.document, window.panel("skin")
    level = skin.content.values
    settings = SkinSettings(quantity="sensation", map_style=style)
    document.look(with_settings(document.view, "skin", settings))
    settle()
    assert skin.content.values is not level
    assert (skin.content.field_values is None) == (style == "sensors")
    assert "people differ" in skin.note.toolTip()
    assert "threshold" in skin.content.quantity.unit
    skin.picture(300, 500)
    relative = replace(document.design, scaling="upstream")
    document.apply(Edit(label="Scaling", design=relative, view=document.view))
    settle()
    assert "Probe acceleration" in skin.content.message
    assert skin.content.coloured_values is None
    document.look(with_settings(document.view, "skin", SkinSettings()))
    settle()
    assert skin.content.message == ""
    assert skin.content.quantity.name == "levels"


def test_of_many_contacts_the_largest_is_said_and_all_are_listed():
    weighted = tuple((place, 0.5 + 0.1 * (place == 4)) for place in range(1, 21))
    text = contact_text(weighted)
    assert "largest 0.6 m\u2060/\u2060s² RMS at place 4, of 20 places" in text
    assert contact_list(weighted).count("place ") == 20
    assert contact_table(weighted).splitlines()[5] == "4\t0.6"
    few = weighted[:2]
    assert "place 1: 0.5 m\u2060/\u2060s², place 2: 0.5" in contact_text(few)
    assert contact_list(few) == ""
    assert contact_table(None) == contact_table(()) == contact_text(()) == ""


def test_what_is_not_felt_has_no_strength():
    levels = {"P": np.array([-200.0, 12.0]), "NP I": np.array([-200.0, 3.0])}
    sensation = Sensation(
        level_db=np.array([-200.0, 12.0]), by_channel=levels, strength=np.array([0.0, 1.5])
    )
    silent, loud = rows(sensation, (1, 2))
    assert silent.texts[1:] == ("–",) * 4
    assert loud.texts[1:] == ("12.0", "12.0", "3.0", "1.5")
    _, silent, loud = (line.split("\t") for line in table_text(sensation, (1, 2)).splitlines())
    assert silent[2:] == [""] * 4
    assert loud[2:] == ["12.0", "12.0", "3.0", "1.5"]


def test_why_a_table_was_refused_is_said_until_thresholds_are_taken(window, settle, tmp_path):
    panel = analysis(window, "perception")
    wrong, right = tmp_path / "wrong.csv", tmp_path / "right.csv"
    wrong.write_text("nonsense")
    right.write_text("frequency_hz,threshold_m_per_s2\n25,0.1\n600,0.1\n")
    for repair, source in (
        (lambda: panel.import_thresholds(right), "right.csv"),
        (panel.model.click, "the model"),
    ):
        panel.import_thresholds(wrong)
        settle()
        assert "line 1" in window.notice.text
        repair()
        assert window.notice.text == ""
        assert window.statusBar().currentMessage() == f"Thresholds are those of {source}"


def the_wave():
    """A tone burst that passes four points at 10 m/s."""
    rate, way_mm = 4000.0, np.array([0.0, 20.0, 40.0, 60.0])
    time = np.arange(2000) / rate
    burst = [np.exp(-(((time - 0.2 - d / 1e4) * 60.0) ** 2)) for d in way_mm]
    carried = [
        b * np.sin(2 * np.pi * 150.0 * (time - d / 1e4)) for b, d in zip(burst, way_mm, strict=True)
    ]
    return travelling_wave(np.array(carried), way_mm, rate)


NOTHING = {"speed_m_per_s": np.nan, "speed_deviation_m_per_s": np.nan}
OUT_OF_STEP = "No speed: delays do not grow with the distance"


@pytest.mark.parametrize(
    ("changes", "begin"),
    [
        ({}, "Speed 10.0 ± "),
        # A speed that is less sure than itself is none.
        ({"speed_m_per_s": 688.1, "speed_deviation_m_per_s": 3090.9}, OUT_OF_STEP),
        ({"speed_m_per_s": -20.0, "speed_deviation_m_per_s": 30.0}, "No speed"),
        ({**NOTHING, "straight": 0.2}, "No speed: the selected outputs do not form a line · att"),
        ({**NOTHING, "explained": 0.4}, OUT_OF_STEP),
        (NOTHING, "No speed: farther outputs are not reached later"),
    ],
)
def test_a_speed_is_said_only_where_delays_grow_with_the_way(changes, begin):
    assert wave_text(replace(the_wave(), **changes)).startswith(begin)


def test_one_output_above_the_noise_has_neither_speed_nor_attenuation():
    counted = np.array([True, False, False, False])
    text = wave_text(replace(the_wave(), counted=counted, timed=counted))
    assert text == "fewer than two outputs are more than noise"
