"""An input that cannot be played blanks nothing: the others are shown, and it is marked."""

import numpy as np
import pytest

import skinsource as ss
from skinsource import Design, Input, View, track
from skinsource.design.presets.presets import read_preset, shipped_folder
from skinsource.design.waveforms import Chirplet
from tests.core.test_unplayable_inputs import EQUALISED, TONE
from tests.gui.curve_panels.bench import plot_of

HEARTBEAT = Input(
    location=6, clips=read_preset(shipped_folder() / "heartbeat.skinpreset").fragment.lanes[0].clips
)
DESIGNS = {
    "cannot be followed": Design(limb="synthetic-1", inputs=(TONE, HEARTBEAT), actuation=EQUALISED),
    "cannot be sampled": Design(limb="synthetic-1", inputs=(TONE, track(8, Chirplet(600.0)))),
}
VIEW = View(selected_inputs=(2,), outputs=(29,))


@pytest.fixture(params=DESIGNS)
def design(request):
    return DESIGNS[request.param]


@pytest.fixture
def window(open_window, design):
    return open_window(design, VIEW)


def content(window):
    return window.panel("timeline").lanes.content


def test_the_others_are_shown_as_if_it_were_muted(window, design, settle):
    skin, tone = window.panel("skin"), design.clips[0]
    muted = design.with_input(1, muted=True)
    expected = ss.evaluate(muted, "output_levels_db")["output_levels_db"]
    np.testing.assert_allclose(skin.map.content.values, expected, atol=1e-9)
    assert content(window).waveforms[tone.id].size


def test_it_is_said_once_and_marked(window, design, settle):
    good, bad = content(window).lanes
    assert window.notice.text.startswith(f"Input at place {bad.track.location}")
    assert bad.problem.startswith(window.notice.text.removesuffix("."))
    assert all(each.width() >= each.sizeHint().width() for each in window.notice._choices)
    messages = [window.panel("skin").map.content.message]
    messages += [plot_of(window.panel(name)).message for name in ("traces", "spectra")]
    assert messages == ["", "", ""]
    assert (good.problem, bad.silent) == ("", "cannot be played")
    assert content(window).unplayable_on(good) == frozenset()
    assert content(window).unplayable_on(bad) == {clip.id for clip in bad.track.clips}


def test_closed_it_is_not_said_again_until_it_is_something_else(window, design, settle):
    document = window.document
    message = window.notice.text
    window.notice.be_quiet()
    document.edit("Amplitude", design.with_input(0, amplitude=0.5))
    settle()
    assert window.notice.text == ""
    document.edit("Mute", document.design.with_input(1, muted=True))
    settle()
    document.undo_stack.undo()
    settle()
    assert window.notice.text == message


def test_lamps_stay_lit_and_say_what_is_left_out(window, settle, qtbot):
    lamps = window.conditions.chip
    qtbot.waitUntil(lambda: bool(lamps.findings), timeout=30_000)
    states = {finding.name: finding.state for finding in lamps.findings}
    assert states["inputs"] == "left"
    assert states["band"] == "kept"
    assert "cannot be played" in window.panel("skin").caption()


def test_snapshots_keep_their_numbers(window, design, settle, qtbot):
    window.docks["compare"].bring_forward()
    panel, message = window.panel("compare"), window.notice.text
    qtbot.waitUntil(panel.isVisible)
    window.comparison.store("1")
    settle()
    card = panel.cards[0]
    qtbot.waitUntil(lambda: card.compared.values is not None, timeout=30_000)
    expected = window.panel("skin").map.content.values
    np.testing.assert_allclose(card.compared.values["output_levels_db"], expected, atol=1e-9)
    assert card.compared.left_out == message
    assert message in card.accessibleName()
