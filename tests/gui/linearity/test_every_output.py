"""How straight all outputs are, not only the selected ones: drawn, said and copied."""

import numpy as np
import pytest

import skinsource as ss
from skinsource.design.panel_settings import settings_of
from skinsource.engine.evaluation import evaluate
from skinsource.studies.figures.figures import lines_of
from skinsource_gui.panels.linearity.content import diagrams_of_proportion, of_amplitudes
from skinsource_gui.panels.linearity.settings import LinearitySettings
from tests.gui.linearity.test_linearity_content import ROWS, TIME_S, bent
from tests.gui.linearity.test_linearity_panel import OUTPUTS, STRENGTHS, settled, show
from tests.gui.linearity.test_strengths_and_bands import switch

__all__ = ["show"]


def test_adjusted_r2_is_told_of_all_outputs(show, qtbot):
    window, panel = show(STRENGTHS)
    assert [curve.rank for curve in panel.picture.diagrams[2].curves] == [0, 1]
    switch(window, panel, qtbot, "every_output")
    qtbot.waitUntil(lambda: panel.all_outputs is not None, timeout=30_000)
    assert settings_of(window.document.view, "linearity", LinearitySettings).every_output
    assert panel.all_outputs.adjusted_r2.shape[:2] == (72, 1)
    straight = panel.picture.diagrams[2]
    assert [curve.label for curve in straight.curves] == ["median", "worst"]
    assert straight.y.title == "Adjusted R², all outputs"
    assert "of all 72 outputs" in panel.note_label.text
    head, *rows = (line.split("\t") for line in panel.table().splitlines())
    assert head == ["frequency_hz", *(f"adjusted_r2_{k}_z" for k in range(1, 73))]
    assert len(rows) == panel.all_outputs.frequency_hz.size
    panel.grab()
    switch(window, panel, qtbot, "every_output")
    qtbot.waitUntil(lambda: panel.all_outputs is None)
    assert [curve.rank for curve in panel.picture.diagrams[2].curves] == [0, 1]


def test_selected_outputs_are_as_straight_among_all_as_alone(show, qtbot):
    window, panel = show(STRENGTHS)
    switch(window, panel, qtbot, "every_output")
    qtbot.waitUntil(lambda: panel.all_outputs is not None, timeout=30_000)
    for row, output in enumerate(OUTPUTS):
        alone = panel.result.adjusted_r2[row]
        assert panel.all_outputs.adjusted_r2[output - 1, 0] == pytest.approx(alone, abs=1e-12)


def test_the_worst_of_all_outputs_is_drawn_below_their_median():
    fits = bent()
    n_bins = fits.frequency_hz.size
    every = np.stack([np.full(n_bins, ratio) for ratio in (1.0, 0.98, 0.5)])
    every[:, 0] = np.nan
    *_, straight = diagrams_of_proportion(
        fits, ROWS, TIME_S, None, of_amplitudes("V"), all_outputs=every
    )
    median, worst = straight.curves
    assert median.y == pytest.approx(0.98)
    assert worst.y == pytest.approx(0.5)
    # Where nothing is heard there is no line that could be straight.
    assert worst.x == pytest.approx(fits.frequency_hz[1:])
    silent = np.full((3, n_bins), np.nan)
    *_, straight = diagrams_of_proportion(
        fits, ROWS, TIME_S, None, of_amplitudes("V"), all_outputs=silent
    )
    assert straight.curves == ()


def test_what_is_too_long_to_be_transformed_at_once_has_no_bands_of_all_outputs():
    long = ss.Design(
        limb="synthetic-1",
        inputs=(ss.track(8, ss.waveforms.Tone(frequency_hz=100.0, duration_s=600.0)),),
    )
    assert evaluate(long, "output_band_rms")["output_band_rms"] is None


def test_the_scene_of_straightness_tells_all_outputs_of_its_figure(window, qtbot):
    window.scenes.open("5E")
    panel = window.panel("linearity")
    qtbot.waitUntil(lambda: panel.all_outputs is not None, timeout=60_000)
    qtbot.waitUntil(lambda: settled(window, panel))
    assert panel.every_output.isChecked()
    rows = [line.split("\t") for line in panel.table().splitlines()[1:]]
    fits = lines_of(ss.scenes.open_scene("5E"))
    numbers = np.array([[float(cell) for cell in row] for row in rows])[: fits.frequency_hz.size]
    assert numbers[:, 0] == pytest.approx(fits.frequency_hz)
    of_outputs = numbers[:, 1:].T
    assert of_outputs == pytest.approx(fits.adjusted_r2, abs=1e-9)
    assert "selected" not in window.document.design.notes
