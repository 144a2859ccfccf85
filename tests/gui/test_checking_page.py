"""The page that holds predictions against recordings: chosen, checked as a job, reported."""

import numpy as np
import pytest
from PySide6.QtWidgets import QPushButton
from shiboken6 import isValid

import skinsource as ss
from skinsource import View, resample, save_design
from skinsource.studies.checking import Condition
from skinsource_gui.pages.checking import CheckingPage


def design_of(frequency_hz):
    tone = ss.waveforms.Tone(frequency_hz=frequency_hz, duration_s=0.1)
    return ss.Design(limb="synthetic-1", inputs=(ss.track(8, tone),))


def field_of(design):
    view = View(outputs=tuple(range(1, 73)))
    return ss.evaluate(design, "axis_traces", view=view)["axis_traces"]


def button(page, name):
    return page.findChild(QPushButton, name)


@pytest.fixture
def page(open_window, qtbot):
    window = open_window(design_of(104.0))
    window.do("check_recording")
    page = window.findChild(CheckingPage)
    yield page
    if isValid(page):
        page.close()


def checked(page, qtbot):
    button(page, "check_designs").click()
    assert not button(page, "check_designs").isEnabled()
    qtbot.waitUntil(lambda: not page.run.busy, timeout=60_000)
    return page.rows


def test_designs_are_checked_against_recordings_of_other_rates_and_reported(page, qtbot, tmp_path):
    other = design_of(52.0)
    save_design(tmp_path / "low.skinsource", other, View())
    first, second = field_of(design_of(104.0)), field_of(other)
    # Times x outputs x axes, at twice the rate, which the file says.
    twice = resample(first, 1300, 2600)
    np.savez(tmp_path / "high.npz", response=3.0 * np.moveaxis(twice, -1, 0), fs=2600.0)
    # Columns without a rate, noisy: r is 1 / sqrt(1 + 1/4).
    rms = np.sqrt(np.mean(second**2, axis=-1, keepdims=True))
    noisy = second + 0.5 * rms * np.random.default_rng(5).normal(size=second.shape)
    np.savez(tmp_path / "low.npz", response=noisy.reshape(216, -1).T)
    page.take_recording(tmp_path / "high.npz")
    page.add_design(tmp_path / "low.skinsource")
    page.take_recording(tmp_path / "low.npz")
    high, low = (row.result for row in checked(page, qtbot))
    assert high.agreement.counted.all()
    assert high.agreement.medians[2] > 0.99
    assert low.agreement.medians[2] == pytest.approx(1.0 / np.sqrt(1.25), abs=0.02)
    assert [round(float(label), -1) for label, _ in page.boxes[2].groups] == [50.0, 100.0]
    channels = page.table.item(0, 5)
    assert channels.text() == "216 of 216"
    assert channels.toolTip() == "Noise from before the response in the recording"
    assert "above 0.5" in page.message.text()
    for box in page.boxes:
        assert not box.message
        assert not box.grab().isNull()
        box.move_cursor(box.keys_area().center())
        assert "median" in page.message.text()
    page.save(tmp_path / "report.html")
    written = (tmp_path / "report.html").read_text()
    assert written.count("<svg") == 3
    assert "low.skinsource" in written
    assert "Synthetic 1" in written
    # Along another axis it would be another result.
    page.axes.choose("z")
    assert [row.result for row in page.rows] == [None, None]
    assert not button(page, "save_report").isEnabled()
    assert all(box.message for box in page.boxes)


def test_what_does_not_fit_is_said_in_its_row_and_the_others_are_checked(page, qtbot, tmp_path):
    np.savez(tmp_path / "small.npz", response=np.ones((50, 6, 3)), fs=1300.0)
    save_design(tmp_path / "other.skinsource", design_of(200.0), View())
    np.savez(tmp_path / "z.npz", response=np.ones((600, 72)), fs=1300.0)
    checked(page, qtbot)
    assert page.message.text() == "Checked. Choose a recording to compare with."
    page.take_recording(tmp_path / "z.npz")
    assert page.message.text() == "z.npz is chosen for This design. Now press Check."
    (flat,) = checked(page, qtbot)
    assert "or choose one axis (x, y or z), which takes 72 signals" in flat.result
    assert page.message.property("tone") == "error"
    page.axes.choose("z")
    # What was wrong along all axes is not said of this one.
    assert page.message.text() == "Now press Check."
    assert page.message.property("tone") == ""
    (along_z,) = checked(page, qtbot)
    assert isinstance(along_z.result, Condition)
    page.axes.choose("all")
    page.take_recording(tmp_path / "small.npz")
    page.add_design(tmp_path / "other.skinsource")
    refused, alone = (row.result for row in checked(page, qtbot))
    assert "expected times × 72 outputs × 3 axes" in refused
    assert isinstance(alone, Condition)
    assert alone.linear == pytest.approx(1.0)
    assert alone.agreement is None
    assert "50 × 6 × 3" in page.message.text()
    page.add_design(tmp_path / "none.skinsource")
    assert "none.skinsource" in page.message.text()
    button(page, "remove_design").click()
    button(page, "remove_design").click()
    assert page.rows == ()
    assert not button(page, "check_designs").isEnabled()
