"""The panels of analysis on limbs of a lab: its names, axes and rate, or plainly why not."""

import numpy as np
import pytest

from skinsource import Design, View, edits, evaluate, track
from skinsource.design.waveforms.tones import Tone
from skinsource.engine.analysis_rules import Sensation
from skinsource_gui.panels.analysis.view import FigureView
from tests.core.own_limbs.lab_bench import N_OUTPUTS, installed
from tests.gui.analysis.analysis_bench import analysis

PANELS = (
    "statistics",
    "spectrogram",
    "transfer",
    "main_axis",
    "wave",
    "perception",
    "regions",
    "windowed",
    "compare",
)
NAMES = tuple(f"sensor {k}" for k in range(1, N_OUTPUTS + 1))
DESIGN = Design(
    limb="synthetic-1", inputs=(track(3, Tone(frequency_hz=700.0, duration_s=0.1)), track(6))
)


@pytest.fixture(params=["xz", "x"])
def window(request, user_data, open_window):
    installed(axes=request.param, output_names=NAMES)
    view = View(method="mag", outputs=(4, 31, 9), panels=(("compare", (("of", "limbs"),)),))
    edit = edits.change_limb(DESIGN, view, "lab-1")
    return open_window(edit.design, edit.view)


def shown(window, name, qtbot):
    """A panel with what it says of the present design."""
    if name == "compare":
        window.docks[name].bring_forward()
        panel = window.panel(name)
    else:
        panel = analysis(window, name)
    qtbot.waitUntil(lambda: not window.engine.busy, timeout=30_000)
    assert not panel.grab().isNull()
    if isinstance(panel, FigureView) and name != "main_axis":
        assert panel.figure.message == ""
    return panel


def test_each_panel_of_analysis_says_what_the_limb_says(window, qtbot):
    one_axis = window.document.view.axes == "x"
    panels = {name: shown(window, name, qtbot) for name in PANELS}
    assert window.notice.text == ""
    rows = panels["statistics"].rows
    assert [row.name for row in rows] == ["sensor 4", "sensor 31", "sensor 9"]
    assert all(600.0 < row.values[3] < 800.0 or row.values[3] < 200.0 for row in rows)
    spectrogram = panels["spectrogram"]
    assert spectrogram.output.itemText(1) == "31 sensor 31"
    assert "sensor 9" in spectrogram.note_label.whole
    transfer = panels["transfer"]
    assert "From place 3, site 3" in transfer.place.whole
    # A lab does not say in which band it measured: nothing is shaded, all frequencies count.
    assert transfer.picture.content.transfer.band_hz is None
    assert "from 0 to 2000 Hz" in transfer.note_label.whole
    judged = evaluate(window.document.design, "validity", view=window.document.view)["validity"]
    assert {finding.name: finding.state for finding in judged}["band"] == "unknown"
    assert float(transfer.table_text().splitlines()[-1].split("\t")[0]) == pytest.approx(
        2000.0, abs=25
    )
    wave = panels["wave"]
    axis = "x" if one_axis else "z"
    assert wave.about.whole.startswith(f"Along {axis}")
    assert f"level_{axis}_db_re_1_m_per_s2" in wave.table_text()
    if one_axis:
        assert "measured along one only" in panels["main_axis"].figure.message
    else:
        assert "sensor 4" in panels["main_axis"].picture.content.text_of(0)
        assert "local to each sensor" not in panels["main_axis"].note_label.whole
    windowed = panels["windowed"]
    assert windowed.strip.content.levels_db.shape[1] == N_OUTPUTS
    assert windowed.strip.message == ""
    assert "Lab 1" in windowed._heading()
    assert "unknown" in panels["regions"].about.whole
    assert "only for the published limbs" in panels["perception"].message
    assert panels["compare"].maps.content.message.startswith("There is no other limb")


def test_as_many_outputs_do_not_make_an_own_limb_a_published_one(user_data):
    from skinsource.limbs.own_limbs import install_limb
    from tests.core.own_limbs.lab_bench import own_limb

    rng = np.random.default_rng(2)
    places = rng.uniform(-30, 30, (72, 2))
    limb = own_limb(output_positions=places, n_taps=20, axes="z")
    install_limb(limb, (rng.standard_normal((72, 1, 20)) for _ in range(7)))
    design = Design(limb="lab-1", inputs=(track(3),))
    sensation: Sensation = evaluate(design, "sensation", view=View(axes="z"))["sensation"]
    assert "only for the published limbs" in sensation.problem
