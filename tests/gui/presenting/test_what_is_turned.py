"""The one control that a scene is about."""

from dataclasses import replace

from PySide6.QtWidgets import QLabel

import skinsource as ss
from skinsource.design.panel_settings import with_settings
from skinsource_gui.fields.choice_field import ChoiceField
from skinsource_gui.panels.frequency_and_amplitude.settings import ControlSettings


def test_a_scene_says_what_is_turned(make_window, design):
    window = make_window(design)
    window.do("arrange_presentation")
    view, panel = window.document.view, window.panel("frequency_and_amplitude")
    for control, shown in {
        "onset": {"onset_s"},
        "all": {"frequency_hz", "amplitude"},
        "frequency": {"frequency_hz"},
        "amplitude": {"amplitude"},
    }.items():
        window.document.look(
            with_settings(view, "frequency_and_amplitude", ControlSettings(control=control))
        )
        cells = {"amplitude": panel._amplitude, "onset_s": panel._onset}
        if panel._frequency is not None:
            cells["frequency_hz"] = panel._frequency
        assert {name for name, cell in cells.items() if cell.isVisible()} == shown, control


def test_turning_the_onset_moves_the_clip(make_window, design):
    window = make_window(design)
    panel = window.panel("frequency_and_amplitude")
    panel._change("onset_s", 0.1, None)
    assert window.document.design.inputs[0].clips[0].onset_s == 0.1


def test_the_list_of_what_is_turned_has_its_label(window):
    panel = window.panel("frequency_and_amplitude")
    fields = panel.findChildren(ChoiceField, "control_field")
    labels = [label for label in panel.findChildren(QLabel) if label.buddy() in fields]
    assert [label.text() for label in labels] == ["Turn"]


def test_what_plays_is_called_as_it_is_elsewhere(make_window, design):
    train = ss.track(7, ss.waveforms.WaveletTrain())
    window = make_window(replace(design, inputs=(train,)))
    (track,) = window.document.design.inputs
    window.document.look(replace(window.document.view, selected_inputs=(track.id,)))
    panel = window.panel("frequency_and_amplitude")
    assert panel._heading.text() == "Wavelet train at place 7"


def test_the_only_input_is_turned_without_being_selected(make_window, design):
    window = make_window(replace(design, inputs=design.inputs[:1]))
    window.do("arrange_presentation")
    panel = window.panel("frequency_and_amplitude")
    unselected = replace(window.document.view, selected_inputs=())
    window.document.look(unselected)
    assert "place 7" in panel._heading.text()
    assert not panel._amplitude_part.isHidden()
    panel._change("amplitude", 0.25, None)
    assert window.document.design.inputs[0].amplitude == 0.25
    panel._change("frequency_hz", 60.0, None)
    assert window.document.design.inputs[0].clips[0].waveform.frequency_hz == 60.0


def test_of_several_inputs_one_is_selected_before_it_is_turned(make_window, design):
    window = make_window(design)
    window.do("arrange_presentation")
    panel = window.panel("frequency_and_amplitude")
    window.document.look(replace(window.document.view, selected_inputs=()))
    assert "elect an input" in panel._heading.text()
    assert panel._amplitude_part.isHidden()
