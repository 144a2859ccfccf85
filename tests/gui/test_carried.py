"""What pictures and numbers outside say they are not good for; small maps in them and in lists."""

import re
from dataclasses import replace

import numpy as np
import pytest
from PySide6.QtCore import QBuffer, QRectF
from PySide6.QtGui import QColor, QImage, QPainter
from PySide6.QtSvg import QSvgGenerator
from PySide6.QtWidgets import QApplication

import skinsource as ss
from skinsource.design.design import View
from skinsource.design.panel_settings import with_settings
from skinsource_gui.panels.analysis.settings import VIEWS
from skinsource_gui.panels.compare.settings import CompareSettings
from skinsource_gui.plots.colour_maps import colour_table
from skinsource_gui.plots.pictures import ALL_VISIBLE, drawn_image, save_drawing
from skinsource_gui.plots.small_map import (
    LevelStyle,
    SmallMap,
    level_style,
    paint_small_bar,
    paint_small_map,
    with_colours_of,
)
from skinsource_gui.qt.questions import CopyButton
from skinsource_gui.qt.theme import LIGHT, on_paper
from skinsource_gui.shell.panels import PANELS
from tests.gui.analysis.analysis_bench import analysis, look_at

#: Too fast, too high, and on a synthetic limb.
DESIGN = ss.Design(
    limb="synthetic-1",
    inputs=(ss.track(7, ss.waveforms.Tone(frequency_hz=400.0, duration_s=0.1), amplitude=500.0),),
)
SAID = (
    "Peak probe velocity",
    "above 40 mm/s the skin no longer responds linearly.",
    "Responses are computed from a model, not measured.",
)
GUESSED = "of the energy lies above 300 Hz: between outputs the map is a guess."
#: Panels that draw maps between outputs; all in sight do too.
MAPS = ("skin", "stage", "compare", "analysis/windowed", ALL_VISIBLE)
EVERY = (
    *(spec.panel.name for spec in PANELS),
    *(f"analysis/{view.name}" for view in VIEWS),
    ALL_VISIBLE,
)


@pytest.fixture
def window(make_window):
    """A studio of each test's own."""
    return make_window(DESIGN)


def drawn(window, name, path, size=(900, 700)):
    """Words of a picture as a file, as they are searched for."""
    save_drawing(path, window.pictures.picture_of(name).draw, *size)
    text = re.sub(r"<[^>]+>", " ", path.read_text("utf-8"))
    return re.sub(r"\s+", " ", text.replace("\N{NO-BREAK SPACE}", " "))


def test_below_each_panel_stands_once_each_condition_that_is_not_kept(window, tmp_path):
    for name in EVERY:
        text = drawn(window, name, tmp_path / "a.svg")
        assert {phrase: text.count(phrase) for phrase in SAID} == dict.fromkeys(SAID, 1), name
        assert text.count(GUESSED) == (name in MAPS), name
        assert "Tone 400 Hz" in text, name
        assert "Limb" in text, name


def test_what_is_kept_is_not_said(open_window, tmp_path):
    quiet = replace(DESIGN, inputs=(ss.track(7, ss.waveforms.Tone(frequency_hz=100.0)),))
    window = open_window(quiet)
    text = drawn(window, "analysis/windowed", tmp_path / "a.svg")
    assert "Peak probe velocity" not in text
    assert "300 Hz" not in text
    assert "Responses are computed from a model" in text


def test_each_limb_of_a_comparison_is_named_with_what_there_is_to_note_of_it(window, monkeypatch):
    notes = {"synthetic-1": "", "synthetic-2": "made anew", "synthetic-3": "made anew"}
    judge = window.pictures._metadata._judging.judge
    monkeypatch.setattr(
        window.pictures._metadata._judging,
        "judge",
        lambda label, given, *, present: replace(
            judge(label, given, present=present), note=notes.get(given["limb"], "")
        ),
    )
    of_limbs = with_settings(window.document.view, "compare", CompareSettings(of="limbs"))
    window.document.look(of_limbs)
    caption = window.pictures.picture_of("compare").caption
    assert "Limbs: Synthetic 1 (175 mm), Synthetic 2" in caption
    assert "Synthetic 2, Synthetic 3: Made anew." in caption
    assert caption.count("Responses are computed") == 1
    assert "Limb: Synthetic 1 (175 mm);" in window.pictures.picture_of("analysis/windowed").caption


def test_a_picture_of_maps_in_motion_says_at_which_instant_it_is(window, tmp_path, settle):
    moving = CompareSettings(of="axes", shown="motion")
    window.document.look(with_settings(window.document.view, "compare", moving))
    window.docks["compare"].bring_forward()
    settle()
    # Tests move it by themselves.
    panel = window.panel("compare")
    panel.clock.held, panel.moving.turns = True, 0.25
    panel.move_on(0.0)
    for name in ("compare", ALL_VISIBLE):
        assert panel.moving.clock_text in drawn(window, name, tmp_path / "a.svg")


def test_snapshots_that_do_not_keep_a_condition_are_named_with_it(window, settle):
    window.do("store_snapshot_1")
    window.document.edit("Softer", DESIGN.with_input(0, amplitude=1.0))
    settle()
    caption = window.pictures.picture_of("compare").caption
    assert "Snapshot 1: Peak probe velocity" in caption
    assert "Peak probe velocity" not in window.pictures.picture_of("analysis/windowed").caption


def test_copied_numbers_are_followed_by_what_they_are_not_good_for(window, qtbot):
    panel = analysis(window, "statistics")
    qtbot.waitUntil(lambda: len(panel.rows) > 0, timeout=30_000)
    [button] = window.panel("analysis").findChildren(CopyButton)
    button.click()
    *_, last = lines = QApplication.clipboard().text().splitlines()
    assert lines[0].startswith("output\t")
    about = [line for line in lines if line.startswith("# ")]
    assert any(line.startswith("# validity, drive: CAUTION: Peak probe velocity") for line in about)
    assert last in about


FOUR = ". ".join(
    f"Snapshot {1 + k}: Place 7, 1 m/s²: Tone {50 * 2**k} Hz, 200 ms" for k in range(4)
)


def test_a_scene_that_was_changed_is_not_called_what_it_was(window, settle):
    # Four frequencies, as snapshots of a scene of the paper.
    opened = ss.scenes.open_scene("2B", available=("synthetic-1",))
    window.document.start_over(opened.design, opened.view, None, scene=opened.scene.title)
    settle()
    title = "Fig. 2B: Low frequencies reach farther"
    heading = window.panel("stage").heading
    window.docks["stage"].bring_forward()
    window.document.look(replace(window.document.view, selected_inputs=window.document.design.ids))
    settle()
    tone = ss.waveforms.Tone(frequency_hz=300.0)
    track = window.document.design.inputs[0]
    changed = replace(track, clips=(replace(track.clips[0], waveform=tone),))
    window.document.edit("Frequency", replace(window.document.design, inputs=(changed,)))
    settle()
    assert heading.text() == title
    assert window.windowTitle().startswith(f"{title} · edited[*]")
    assert window.pictures.picture_of("skin").caption.startswith(f"{title} · edited. Place 7")
    assert window.pictures.picture_of("compare").caption.startswith(
        f"{title}. Working design: Place 7, 1 m/s²: Tone 300 Hz, 200 ms. {FOUR}"
    )
    window.document.undo_stack.undo()
    settle()
    assert heading.text() == title
    assert window.windowTitle().startswith(f"{title} · 50 Hz[*]")


def test_numbers_that_are_copied_are_those_that_are_judged(qtbot):
    numbers = ["of the design before"]

    def judge():
        numbers[:] = ["of the present design"]
        return ("What to know of it.",)

    button = CopyButton("made_up", lambda: f"{numbers[0]}\n")
    qtbot.addWidget(button)
    button.lines = judge
    button.click()
    copied = QApplication.clipboard().text()
    assert copied == "of the present design\n# What to know of it.\n"


def rings_of(limb_map, *places):
    design = ss.Design(limb="synthetic-1", inputs=tuple(ss.track(place) for place in places))
    buffer = QBuffer()
    buffer.open(QBuffer.OpenModeFlag.WriteOnly)
    picture = QSvgGenerator()
    picture.setOutputDevice(buffer)
    painter = QPainter(picture)
    paint_small_map(painter, QRectF(0, 0, 120, 280), SmallMap(limb_map=limb_map), design, LIGHT)
    painter.end()
    drawn = bytes(buffer.data().data())
    assert b"nan" not in drawn
    return drawn.count(b"<circle") + drawn.count(b"<ellipse")


@pytest.mark.parametrize(("places", "inputs"), [((8, 13), 2), ((3,), 0), ((3, 8), 1)])
def test_an_input_without_a_place_on_the_map_has_no_ring(qapp, places, inputs):
    limb_map = ss.load_limb("synthetic-1").map
    positions = limb_map.input_positions.copy()
    positions[2] = np.nan
    # Each ring has a light edge below it.
    assert rings_of(replace(limb_map, input_positions=positions), *places) == 2 * inputs


@pytest.mark.parametrize(("limb", "hand_mm"), [("synthetic-1", 175.0), ("synthetic-3", 185.0)])
def test_the_bar_is_as_long_as_it_says_and_on_paper_alone(qapp, limb, hand_mm):
    limb_map = ss.load_limb(limb).map
    area = QRectF(0, 0, 300, 900)

    def painted():
        image = QImage(300, 900, QImage.Format.Format_RGB32)
        image.fill(QColor(LIGHT.base))
        painter = QPainter(image)
        paint_small_bar(painter, area, SmallMap(limb_map=limb_map), limb, LIGHT)
        painter.end()
        return [
            x for x in range(300) if QColor(image.pixel(x, 897)).name() == QColor(LIGHT.text).name()
        ]

    assert painted() == []
    with on_paper():
        dark = painted()
    # The arm is as wide as the area.
    px_per_mm = 300 / np.ptp(limb_map.outline[:, 0]) * limb_map.hand_length_px / hand_mm
    lengths_mm = np.array([100, 50, 20, 10])
    assert np.abs(lengths_mm * px_per_mm - len(dark)).min() <= 1.5
    assert 20 < len(dark) <= 75


#: Pixels of a small map, and of words that happen to have its colours.
MANY, FEW = 100, 20
LEVEL_MAPS = ("skin", "analysis/windowed", "compare")


def n_in(image, colours):
    """How many pixels of a picture have colours of a map; its ends may be those of words."""
    argb = image.convertToFormat(QImage.Format.Format_RGB32)
    pixels = np.frombuffer(argb.constBits(), np.uint32).reshape(argb.height(), -1)
    pixels = pixels[:, : argb.width()] | np.uint32(0xFF000000)
    return int(np.isin(pixels, colour_table(colours)[8:-8]).sum())


def look_at_maps(window, qtbot, name):
    """Bring a panel into sight, and wait until it has maps."""
    if name == "compare":
        limbs = with_settings(window.document.view, "compare", CompareSettings(of="limbs"))
        window.document.look(limbs)
    panel = look_at(window, qtbot, name)
    if "/" in name:
        qtbot.waitUntil(lambda: panel.view.strip.content is not None, timeout=60_000)
    elif name == "compare":
        cells = lambda: panel.maps.content.cells  # noqa: E731
        qtbot.waitUntil(
            lambda: bool(cells()) and all(cell.small for cell in cells()), timeout=60_000
        )
    qtbot.waitUntil(lambda: not window.engine.busy, timeout=60_000)
    QApplication.processEvents()
    return panel


def test_colours_chosen_in_the_menu_are_those_of_every_map_of_levels(window, qtbot):
    for name in LEVEL_MAPS:
        window.do("use_magma_colours")
        panel = look_at_maps(window, qtbot, name)
        picture = drawn_image(window.pictures.picture_of(name).draw, 700, 700)
        for image in (panel.grab().toImage(), picture):
            assert n_in(image, "magma") > MANY, name
            assert n_in(image, "viridis") < FEW, name
        window.do("use_viridis_colours")
        QApplication.processEvents()
        assert n_in(panel.grab().toImage(), "viridis") > MANY, name


def test_a_view_that_has_chosen_colours_itself_keeps_them():
    def in_colours(colours):
        return with_settings(View(), "skin", LevelStyle(colours=colours))

    assert level_style(with_colours_of(View(), in_colours("magma"))).colours == "magma"
    own = in_colours("cividis")
    assert with_colours_of(own, in_colours("magma")) is own
