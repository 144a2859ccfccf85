from PySide6.QtCore import Qt
from PySide6.QtWidgets import QLabel

from skinsource.waveforms import Impulse, Noise, Tone
from skinsource_gui.theme import DARK
from skinsource_gui.widgets.inputs.input_words import duration_text
from skinsource_gui.widgets.inputs.waveform_preview import axis_unit
from tests.gui.inputs.bench import Bench, design_of, waveforms_of


def test_each_row_shows_what_its_input_plays(bench):
    design = bench.design.with_clip(2, waveform=Noise(duration_s=4.0))
    bench.show(design.with_clip(3, waveform=Impulse()))
    before = bench.row(1).preview.grab().toImage()
    bench.panel.show_results(waveforms_of(bench.design))
    assert bench.row(1).preview.grab().toImage() != before
    assert all(row.preview.duration_s is not None for row in bench.rows.rows)


def test_results_of_another_number_of_inputs_are_not_shown(bench):
    bench.panel.show_results(waveforms_of(design_of(7)))
    assert all(row.preview.duration_s is None for row in bench.rows.rows)


def test_a_problem_empties_the_miniatures_and_is_told(bench):
    bench.panel.show_results(waveforms_of(bench.design))
    bench.panel.show_problem("No limb of that name")
    words = bench.panel.findChild(QLabel, "inputs_problem")
    assert (words.text(), words.isVisible()) == ("No limb of that name", True)
    assert all(row.preview.duration_s is None for row in bench.rows.rows)
    bench.panel.show_results(waveforms_of(bench.design))
    assert not words.isVisible()


def test_old_miniatures_turn_pale_only_after_a_while(bench, qtbot):
    bench.panel.show_results(waveforms_of(bench.design))
    fresh = bench.row(0).preview.grab().toImage()
    bench.panel.show_stale(True)
    assert bench.row(0).preview.grab().toImage() == fresh
    qtbot.waitUntil(lambda: bench.row(0).preview.grab().toImage() != fresh)
    bench.panel.show_stale(False)
    assert bench.row(0).preview.grab().toImage() == fresh


def test_fifty_inputs_scroll_and_the_selected_one_is_in_sight(qtbot):
    bench = Bench(qtbot, design_of(*[1 + k % 20 for k in range(50)]))
    bench.key(Qt.Key.Key_End)
    row = bench.row(49)
    assert bench.view.selected_input == 50
    qtbot.waitUntil(lambda: not row.visibleRegion().isEmpty())


def test_the_panel_takes_over_a_theme_and_fits_its_smallest_dock(bench):
    light = bench.panel.grab().toImage()
    bench.panel.show_theme(DARK)
    assert bench.panel.grab().toImage() != light
    assert bench.panel.minimumSizeHint().width() <= 300
    assert bench.panel.minimumSizeHint().height() <= 150


def test_long_waveforms_are_told_in_seconds():
    assert duration_text(Tone(duration_s=0.2)) == "200 ms"
    assert duration_text(Tone(duration_s=0.95)) == "950 ms"
    assert duration_text(Tone(duration_s=9.5)) == "9.5 s"
    assert duration_text(Tone(duration_s=12.25)) == "12.25 s"
    assert duration_text(Tone(duration_s=600.0)) == "600 s"
    assert axis_unit(0.95) == ("ms", 1000.0)
    assert axis_unit(1.0) == ("s", 1.0)
