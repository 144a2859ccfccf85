"""A limb of 7 places and 31 outputs along x and z at 4 kHz, in the whole window; missing limbs."""

from dataclasses import replace

import numpy as np
import pytest
from PySide6.QtCore import QEvent, QPoint, QPointF
from PySide6.QtWidgets import QApplication, QLabel

from skinsource import Design, View, edits, open_design, save_design, track
from skinsource.design.labels import AXES
from skinsource.design.waveforms import Noise, Tone
from skinsource.limbs.own_limbs import facts_of, mirror_limb, remove_limb
from skinsource_gui.fields.choice_field import ChoiceField
from skinsource_gui.state.compared import SILENT
from skinsource_gui.state.engine import Purpose
from tests.core.own_limbs.lab_bench import N_INPUTS, N_OUTPUTS, installed
from tests.gui.shared_window import rest
from tests.gui.skin.bench import entries

PLAYED = Design(
    limb="synthetic-1",
    inputs=(track(5, Tone(frequency_hz=1500.0, duration_s=0.1)), track(2, Noise(seed=1))),
)


@pytest.fixture
def lab(user_data):
    return installed()


@pytest.fixture
def lab_window(lab, open_window):
    edit = edits.change_limb(PLAYED, View(method="mag", outputs=(3, 31, 5)), "lab-1")
    return open_window(edit.design, edit.view)


def lane(window):
    """What the timeline shows of the first input."""
    return window.panel("timeline").lanes.content.lanes[0]


def test_every_panel_shows_it_or_says_plainly_why_not(lab_window):
    for panel in lab_window.panels:
        lab_window.docks[panel.name].show()
        lab_window.docks[panel.name].raise_()
    rest(lab_window)
    assert lab_window.notice.text == ""
    for panel in lab_window.panels:
        assert not panel.grab().isNull()
    content = lab_window.panel("skin").map.content
    assert content.message == ""
    assert content.coloured_values.shape == (N_OUTPUTS,)
    assert np.isfinite(content.field_values).any()


def test_names_places_and_axes_are_those_of_the_limb(lab_window, lab):
    window = lab_window
    limb = window.findChild(ChoiceField, "limb")
    assert limb.shown_text == "Lab 1"
    axes = window.panel("skin").measure.axes
    assert axes.accessibleDescription().startswith("x, z")
    offered = list(entries(axes).values())[: len(AXES)]
    assert [entry.data() for entry in offered if entry.isEnabled()] == ["x", "z", "xz"]
    place = window.panel("inspector").findChild(ChoiceField, "location_field")
    assert place.count() == N_INPUTS
    assert place.shown_text == "5 · site 5"
    hand = window.panel("hand").diagram
    assert hand.stage.layout.n_sites == N_INPUTS
    assert "site 3" in hand.stage.text(3)
    places = window.panel("hand")._places()
    at = tuple(window.panel("skin").map.content.limb_map.output_positions[0])
    assert places.on_map(places.on_drawing(at)) == pytest.approx(at, abs=1e-3)
    drawn = window.panel("skin").map.stage.layout
    assert drawn.unplaced == (5,)
    assert drawn.card_title == "No place"
    assert facts_of(window.document.design.limb).sentence in " ".join(
        window.setup_bar.findChild(ChoiceField, "limb").toolTip().split()
    )


def test_a_new_design_and_one_of_a_file_are_looked_at_as_the_limb_can_be(lab_window):
    window = lab_window
    axes = window.panel("skin").measure.axes
    window.files.new()
    assert window.document.design.limb == "lab-1"
    assert window.document.view.axes == "xz"
    assert axes.accessibleDescription().startswith("x, z")
    view = View(axes="xyz", outputs=(3, 52))
    window.document.start_over(replace(PLAYED, limb="lab-1"), view, None)
    rest(window)
    assert (window.document.view.axes, window.document.view.outputs) == ("xz", (3,))
    assert axes.accessibleDescription().startswith("x, z")
    assert not window.document.modified


def test_a_limb_that_goes_locks_its_design_until_it_is_back(lab_window):
    window = lab_window
    before = window.document.design
    remove_limb("lab-1")
    QApplication.sendEvent(window, QEvent(QEvent.Type.WindowActivate))
    window.document.edit("Mute", before.with_input(0, muted=True))
    assert window.document.design is before
    assert "This design is read-only. The limb 'lab-1' of this design is not here" in (
        window.notice.text
    )
    assert window.findChild(ChoiceField, "limb").shown_text == "lab-1 (not available)"
    installed(hand_length_mm=181.0)
    window.document.edit("Mute", before.with_input(0, muted=True))
    assert "other numbers" in window.notice.text
    installed()
    window.document.edit("Mute", before.with_input(0, muted=True))
    assert window.document.design.inputs[0].muted


def test_a_left_hand_is_mirrored_in_every_panel_on_request(lab_window, lab):
    hand = lab_window.panel("hand").diagram
    before = hand.stage.layout.centres[:, 0].copy()
    mirror_limb("lab-1", True)
    QApplication.sendEvent(lab_window, QEvent(QEvent.Type.WindowActivate))
    rest(lab_window)
    order = np.argsort(before)
    assert (np.argsort(hand.stage.layout.centres[:, 0]) == order[::-1]).all()
    both = lab.outline[:, 0].min() + lab.outline[:, 0].max()
    shown = lab_window.panel("skin").map.content.limb_map
    np.testing.assert_allclose(shown.output_positions[:, 0], both - lab.output_positions[:, 0])


@pytest.mark.parametrize("n_unplaced", [0, 13, 30])
def test_outputs_without_a_place_stand_beside_the_map_however_many(
    user_data, open_window, n_unplaced
):
    places = np.random.default_rng(2).uniform(-30, 30, (N_OUTPUTS, 2))
    places[:n_unplaced] = np.nan
    installed(output_positions=places)
    edit = edits.change_limb(PLAYED, View(outputs=(1, 31)), "lab-1")
    window = open_window(edit.design, edit.view)
    rest(window)
    skin = window.panel("skin").map
    layout = skin.stage.layout
    assert layout.unplaced == tuple(range(1, n_unplaced + 1))
    assert np.isfinite(layout.points).all()
    beside = layout.points[:n_unplaced]
    assert layout.palmar_card.isEmpty() == (n_unplaced == 0)
    assert all(layout.palmar_card.contains(QPointF(*point)) for point in beside)
    assert not skin.grab().isNull()
    assert window.notice.text == ""


def test_a_limb_too_large_to_follow_edits_shows_its_own_places_and_why_there_is_no_more(
    lab, window, qtbot, monkeypatch
):
    rest(window)
    skin, document = window.panel("skin"), window.document
    document.look(replace(document.view, outputs=(3,)))
    assert skin.map.content.limb == "synthetic-1"
    edit = edits.change_limb(document.design, document.view, "lab-1")
    computed = []
    window.engine.finished.connect(computed.append)
    with monkeypatch.context() as fewer:
        fewer.setattr("skinsource.limbs.limb.LIVE_INPUTS", 5)
        document.apply(edit)
        rest(window)
        content = skin.map.content
        assert "live results are possible up to" in content.message
        assert content.limb == "lab-1"
        np.testing.assert_allclose(content.limb_map.output_positions, lab.output_positions)
        assert content.coloured_values is None
        assert not content.synthetic
        assert content.px_per_mm == pytest.approx(lab.hand_length_px / lab.hand_length_mm)
        assert not skin.grab().isNull()
        # No response is read for it, and nothing is judged.
        window.conditions._judge()
        rest(window)
        assert {result.request.purpose for result in computed} == {Purpose.SHOW}
        assert sum(result.work.bytes_read for result in computed) == 0
        assert (window.conditions.chip.findings, window.notice.text) == ((), "")
    document.edit("Softer", document.design.with_input(0, amplitude=0.5))
    qtbot.waitUntil(lambda: skin.map.content.coloured_values is not None, timeout=30_000)


def test_outputs_that_a_limb_lacks_leave_the_selection_and_undo_brings_them_back(lab, window):
    document = window.document
    document.look(replace(document.view, outputs=(3, 52)))
    window.findChild(ChoiceField, "limb").choose("lab-1")
    rest(window)
    assert document.view.outputs == (3,)
    assert window.notice.text == ""
    hand = window.panel("hand").diagram
    assert hand.stage.layout.n_sites == N_INPUTS
    document.undo_stack.undo()
    assert document.view.outputs == (3, 52)
    rest(window)
    assert hand.stage.layout.n_sites == 20
    assert window.panel("skin").map.stage.layout.card_title == "Palm side"


def test_an_input_at_a_place_that_the_limb_lacks_is_said_with_what_to_do(lab, window):
    document = window.document
    document.edit("Move", document.design.with_input(0, location=12))
    window.findChild(ChoiceField, "limb").choose("lab-1")
    rest(window)
    message = "lab-1 has the places 1 to 7, and there is an input at place 12."
    assert window.notice.text == message
    assert lane(window).problem.startswith(f"{message} Move the input, or")
    assert window.panel("skin").map.content.message == SILENT
    document.edit("Move", document.design.with_input(0, location=7))
    rest(window)
    assert (window.notice.text, lane(window).problem) == ("", "")


GONE = Design(limb="lab-9", limb_digest="0" * 64, inputs=(track(6),))


def test_nothing_of_another_limb_is_shown_and_the_window_says_what_is_missing(window):
    # A window that showed a limb, and now a design of one that is missing.
    rest(window)
    assert window.panel("skin").map.content.limb_map is not None
    window.document.start_over(GONE, View(outputs=(3,)), None)
    rest(window)
    hand = window.panel("hand")
    assert not hand.diagram.isVisibleTo(hand)
    assert hand.findChild(QLabel, "hand_missing").text() == "The limb 'lab-9' is missing"
    assert hand.drop_place(QPoint(50, 50)).location is None
    assert "Place 6" in window.panel("inspector").findChild(QLabel, "inspector_heading").toolTip()
    content = window.panel("skin").map.content
    assert (content.limb_map, content.limb) == (None, "lab-9")
    missing = "The limb 'lab-9' of this design is not here. Import it (File > Own limbs…)"
    assert content.message.startswith(missing)
    assert window.notice.text.startswith(missing)
    assert not window.panel("skin").grab().isNull()
    limb = window.setup_bar.findChild(ChoiceField, "limb")
    assert limb.shown_text == "lab-9 (not available)"
    assert "not here" in limb.toolTip()


def test_a_new_design_on_a_limb_whose_file_has_come_back_tells_its_name(user_data, window):
    installed()
    QApplication.sendEvent(window, QEvent(QEvent.Type.WindowActivate))
    design = Design(limb="lab-1", limb_digest=facts_of("lab-1").digest, inputs=(track(6),))
    window.document.start_over(design, View(axes="xz", outputs=(3,)), None)
    rest(window)
    box = window.setup_bar.findChild(ChoiceField, "limb")
    there = box.shown_text
    remove_limb("lab-1")
    QApplication.sendEvent(window, QEvent(QEvent.Type.WindowActivate))
    rest(window)
    assert box.shown_text == "lab-1 (not available)"
    # Nobody left the window in between.
    installed()
    window.files.new()
    rest(window)
    assert window.document.design.limb == "lab-1"
    assert box.shown_text == there


STRANGE = Design(limb="foot-1", inputs=(track(location=7),))


def message(window):
    return window.panel("skin").map.content.message


def test_a_design_for_a_limb_that_is_not_here_opens_is_kept_and_may_have_another_limb(
    window, tmp_path
):
    path = tmp_path / "strange.skinsource"
    save_design(path, STRANGE)
    window.files.open(path)
    rest(window)
    assert window.document.design == STRANGE
    assert "limb 'foot-1' is not available here" in message(window)
    assert window.panel("skin").map.content.coloured_values is None
    limb = window.findChild(ChoiceField, "limb")
    assert limb.shown_text == "foot-1 (not available)"
    assert "(read-only)" in window.windowTitle()
    assert window.files.save()
    assert open_design(path).design == STRANGE
    limb.choose("synthetic-2")
    rest(window)
    assert (window.document.design.limb, message(window)) == ("synthetic-2", "")
    assert np.isfinite(window.panel("skin").map.content.values).all()
