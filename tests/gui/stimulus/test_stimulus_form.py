"""The form of a stimulus starts with what the design has chosen, and remembers the rest."""

from dataclasses import replace

import pytest

import skinsource as ss
from skinsource.actuators.equalising import RegularisedInverse
from skinsource.design.design import View
from skinsource_gui.pages.stimulus.form import StimulusForm, recall, remembered

DESIGN = ss.Design(
    limb="synthetic-1", inputs=(ss.track(7, ss.waveforms.Gabor(200.0, cycles=8.0), onset_s=0.1),)
)
FINGERTIP, TITLE = "kastor-2023-air", "Fingertip voice coil, in air"


def chosen(equaliser, **changes):
    model = replace(ss.actuators.load(FINGERTIP), **changes)
    coil = ss.ActuatorAt(actuator=TITLE, model=model)
    return replace(DESIGN, actuation=ss.Actuation(actuators=(coil,), equaliser=equaliser, on=False))


@pytest.fixture
def form_on(qtbot):
    def make(design, **view):
        form = StimulusForm(design, View(**view))
        qtbot.addWidget(form)
        return form

    return make


def shown(form):
    fields = form.field("actuator"), form.field("equaliser")
    return *(field.value for field in fields), form.field("boost_db").value_si


def texts(field):
    return [field.itemText(row) for row in range(field.count())]


def order_of(form):
    changes = []
    form.changed.connect(changes.append)
    form.emit_order()
    return changes[-1]


def test_changed_parameters_and_equaliser_go_with_it(form_on):
    design = chosen(RegularisedInverse(boost_db=6.0), resistance_ohm=5.5)
    form = form_on(design)
    assert shown(form) == (FINGERTIP, "RegularisedInverse", 6.0)
    edited = []
    form.edited.connect(lambda edit, _: edited.append(edit.design.actuation))
    form.field("phase").choose("minimum")
    after = RegularisedInverse(boost_db=6.0, phase="minimum")
    assert edited == [replace(design.actuation, equaliser=after)]
    # The same again changes nothing.
    form.field("equaliser").choose("RegularisedInverse")
    assert edited[1:] == [design.actuation]


@pytest.mark.parametrize("last", [None, RegularisedInverse(boost_db=3.0)])
def test_what_is_remembered_does_not_replace_what_the_design_says(form_on, last):
    form = form_on(chosen(RegularisedInverse(boost_db=9.0)))
    recall(form, remembered(form_on(chosen(last))))
    assert shown(form) == (FINGERTIP, "RegularisedInverse", 9.0)


def test_tracks_that_are_solo_are_said_where_all_that_are_heard_are_written(form_on):
    design = DESIGN.adding(*DESIGN.inputs)
    form = form_on(design, selected_inputs=())
    field = form.field("plays")
    assert texts(field) == ["All unmuted"]
    form.show_design(design.with_input(0, solo=True))
    assert texts(field) == ["1 of 2 tracks: solo"]
    assert field.isVisibleTo(form)


def test_full_scale_of_equalised_drives_is_in_volts_and_ends_with_them(form_on):
    form = form_on(chosen(RegularisedInverse()))
    assert form.field("full_scale").spec.unit == "V"
    form.choose_full_scale(95.0)
    form.show_design(chosen(None))
    assert form.field("full_scale").spec.unit == "m/s²"
    assert form.field("scale").value == "largest"


WAIT = {"timeout": 30_000}


def test_the_range_between_people_is_asked_for_on_published_limbs(form_on):
    form = form_on(DESIGN)
    assert not order_of(form).options.people
    form.field("people").click()
    assert order_of(form).options.people
    again = form_on(DESIGN)
    recall(again, remembered(form))
    assert order_of(again).options.people
    again.show_design(replace(DESIGN, limb="lab-1"))
    assert again.field("people").isHidden()
    assert not order_of(again).options.people


def test_the_next_page_exports_as_the_last_one_did(form_on):
    form, other = form_on(DESIGN), form_on(DESIGN)
    form.field("format").choose("csv")
    form.field("rate").choose("96000")
    form.field("lead_in").set_value(0.25)
    form.field("lead_in").edited.emit(0.25, None)
    form.field("sync").setChecked(True)
    # What a format can be is kept with it.
    name = next(iter(form.chosen))
    last = form.field(name).itemData(form.field(name).count() - 1)
    form.field(name).choose(last)
    recall(other, remembered(form))
    assert other.chosen == form.chosen
    assert other.chosen[name] == last
    assert order_of(other) == order_of(form)
    assert order_of(other).options.lead_in_s == 0.25


def test_a_name_without_an_ending_gets_all_of_it_and_the_format_is_remembered(
    make_desk, qtbot, answers, tmp_path
):
    desk, answers["save"] = make_desk(DESIGN), str(tmp_path / "x.tsv")
    desk.exports.show("stimulus")
    page = desk.exports.page.part
    page.form.field("format").choose("bids")
    qtbot.waitUntil(lambda: page.ready and not page.busy, **WAIT)
    page.window().chosen.emit()
    qtbot.waitUntil(lambda: (tmp_path / "x_stim.tsv.gz").exists(), **WAIT)
    desk.exports.show("stimulus")
    assert desk.exports.page.part.form.field("format").value == "bids"
