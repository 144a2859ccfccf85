"""Limbs too large to follow edits: what needs no response is shown all the same."""

from dataclasses import replace

import numpy as np
import pytest

from skinsource.design import edits
from skinsource.design.design import Design, track
from skinsource.design.view import View
from skinsource.design.waveforms.pulses import Noise
from skinsource.design.waveforms.tones import Tone
from skinsource.limbs.own_limbs import install_limb
from skinsource_gui.state.engine import FIRST_SLOT, Purpose
from tests.core.own_limbs.lab_bench import own_limb, response

PLAYED = Design(
    limb="synthetic-1",
    inputs=(track(5, Tone(frequency_hz=1500.0, duration_s=0.1)), track(2, Noise(seed=1))),
)


@pytest.fixture
def large(user_data):
    """A limb with a place too many; returns how PLAYED is put onto it."""
    rng = np.random.default_rng(1)
    places = rng.uniform(-30, 30, (65, 2))
    limb = own_limb(input_positions=places, input_names=(), axes="z", n_taps=20)
    install_limb(limb, (response(1, "z")[..., :20] for _ in range(65)))
    return edits.change_limb(PLAYED, View(outputs=(3,)), "lab-1")


@pytest.fixture
def large_window(large, make_window, qtbot):
    window = make_window(large.design, large.view)
    rested(window, qtbot)
    return window


def rested(window, qtbot):
    qtbot.waitUntil(lambda: not window.engine.busy, timeout=30_000)
    window.catch_up()


def test_clips_have_their_waveforms_and_follow_edits(large_window, qtbot):
    window = large_window
    lanes = window.panel("timeline")._table.lanes
    tone, noise = (track.clips[0].id for track in window.document.design.inputs)
    assert set(lanes.content.waveforms) == {tone, noise}
    before = lanes.content.waveforms[tone]
    # 100 ms at the rate of the limb.
    assert before.size == 400
    assert "follow edits up to" in window.panel("skin").map.content.message
    assert window.panel("timeline")._foot.text() == ""
    clip = window.document.design.inputs[0].clips[0]
    slower = replace(clip, waveform=replace(clip.waveform, frequency_hz=100.0))
    window.document.edit("Slower", window.document.design.with_input(0, clips=(slower,)))
    rested(window, qtbot)
    after = lanes.content.waveforms[tone]
    assert not np.array_equal(after, before)
    assert "follow edits up to" in window.panel("skin").map.content.message


def test_no_response_is_read_for_it_and_nothing_is_judged(large, make_window, qtbot):
    results, judged = [], []
    window = make_window(large.design, large.view)
    window.engine.finished.connect(results.append)
    rested(window, qtbot)
    window.validity._judge()
    window.document.edit("Softer", window.document.design.with_input(0, amplitude=0.5))
    rested(window, qtbot)
    window.validity._judge()
    rested(window, qtbot)
    judged = [result for result in results if result.request.purpose is Purpose.JUDGE]
    shown = [result for result in results if result.request.place == (FIRST_SLOT, Purpose.SHOW)]
    assert shown
    assert sum(result.work.bytes_read for result in shown) == 0
    assert judged == []
    assert window.validity.lamps.findings == ()
    assert window.notice.text == ""
