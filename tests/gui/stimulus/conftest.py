"""A design of three tracks at two places, and the page that exports it."""

import pytest

import skinsource as ss
from skinsource.design.design import View
from tests.gui.stimulus.stimulus_bench import WAIT_MS

GABOR = ss.waveforms.Gabor(frequency_hz=200.0)


@pytest.fixture
def design():
    return ss.Design(
        limb="synthetic-1",
        inputs=(
            ss.track(7, GABOR, onset_s=0.06, amplitude=0.5),
            ss.track(12, ss.waveforms.Tone(frequency_hz=100.0), onset_s=0.1),
            ss.track(7, ss.waveforms.Tap(), onset_s=0.2, amplitude=0.25),
        ),
        loop_s=(0.05, 0.15),
    )


@pytest.fixture
def desk(make_desk, design):
    selected = View(selected_inputs=(2,), selected_clips=(design.inputs[1].clips[0].id,))
    return make_desk(design, selected)


def opened(desk, qtbot, kind="stimulus"):
    """The page, once it shows what would be exported."""
    desk.exports.show(kind)
    qtbot.waitExposed(desk.exports.page)
    part = desk.exports.page.part
    qtbot.waitUntil(lambda: not part.busy, timeout=WAIT_MS)
    return part


@pytest.fixture
def page(desk, qtbot):
    return opened(desk, qtbot)


@pytest.fixture
def save_as(answers, tmp_path):
    """Have the next dialog answer with a name."""

    def answer_with(name):
        answers["save"] = str(tmp_path / name)
        return tmp_path / name

    return answer_with
