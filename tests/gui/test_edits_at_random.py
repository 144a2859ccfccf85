"""Any sequence of edits: none raises, undo and redo lead to the same states, ids stay unique."""

from dataclasses import replace

from hypothesis import given, settings
from hypothesis import strategies as st

from skinsource import actuators
from skinsource.actuators.actuation import Actuation, ActuatorAt
from skinsource.base.measurement_conditions import LIMB_NAMES
from skinsource.design import edits
from skinsource.design.design import Design, track
from skinsource.design.effects import EFFECTS
from skinsource.design.motions import MOTIONS, Alternation
from skinsource.design.view import View
from skinsource.design.waveforms.pulses import Noise, Tap
from skinsource.design.waveforms.tones import Tone
from skinsource.perception.validity import Finding
from skinsource_gui.state.document import Document

START = Design(
    limb="synthetic-1",
    inputs=(
        track(location=7, waveform=Tone()),
        track(location=2, waveform=Noise(), colour=1),
        track(location=2, waveform=Tap(), colour=2),
    ),
)
COIL = ActuatorAt(actuator="coil", model=actuators.load("example-voice-coil"))
ACTUATION = Actuation(actuators=(COIL,))
FRAGMENT = edits.fragment_of(START, (1, 3))
fragments = st.just(FRAGMENT)
ids = st.lists(st.integers(-1, 8), max_size=4).map(tuple)
one_id = st.integers(-1, 8)
anything = st.one_of(
    st.none(),
    st.booleans(),
    st.integers(),
    st.floats(),
    st.text(max_size=5),
    st.sampled_from([0.1, 1.0, 100.0, "none", "Tone", 2**70]),
    st.floats(0.0, 0.3),
)
names = st.sampled_from(
    [
        "amplitude",
        "onset_s",
        "frequency_hz",
        "duration_s",
        "seed",
        "window",
        "gains_db",
        "id",
        "colour",
        "",
    ]
)
places = st.integers(-1, 22)
steps_down = st.integers(-3, 3) | anything
waveforms = st.sampled_from([Tone(frequency_hz=33.0), Tap(), None])
curves = st.lists(st.tuples(st.floats(0, 2), st.floats(0, 2)), max_size=3).map(tuple)
switches = st.booleans()
numbers = st.integers(-1, 5)
motions = st.sampled_from([*(kind() for kind in MOTIONS), Alternation(rounds=200), None])
findings = st.builds(
    Finding,
    name=st.just("band"),
    state=st.just("left"),
    sentence=st.just(""),
    repair=st.sampled_from(["", "probe_scaling", "quieter", "band_limit", "deselect", "?"]),
    factor=st.floats(0.1, 1.0),
    outputs=st.just((1, 2, 72)),
)
#: What is handed to each edit, after design and view.
ARGUMENTS = {
    "mend": (findings,),
    "add_effect": (ids, st.sampled_from([*(kind.__name__ for kind in EFFECTS), "Echo"])),
    "change_effect_field": (
        one_id,
        st.integers(-1, 3),
        st.sampled_from(["in_s", "times", "factor", "to_s", "points", "on", "low_hz", ""]),
        anything,
    ),
    "move_effect": (one_id, st.integers(-1, 3), st.integers(-1, 3)),
    "remove_effect": (one_id, st.integers(-1, 3)),
    "set_envelope": (one_id, curves),
    "switch_effect": (one_id, st.integers(-1, 3), switches | anything),
    "add_clip": (one_id, anything, waveforms),
    "add_marker": (anything,),
    "add_motion": (
        st.sampled_from([*(kind() for kind in MOTIONS), Alternation(rounds=200), None]),
    ),
    "bound_clip": (one_id, st.just(1300.0)),
    "draw_clip": (
        one_id,
        st.sampled_from([(0.0, 0.5, -1.0), (), (1.0, float("nan"))]),
        st.sampled_from([1300.0, 48_000.0, 0.0]),
    ),
    "change_field": (ids, names, anything),
    "change_kind": (
        ids,
        st.sampled_from(["Tone", "Tap", "Impulse", "Noise", "WaveletTrain", "Siren"]),
    ),
    "change_limb": (st.sampled_from([*LIMB_NAMES, "", "other"]),),
    "add_input": (),
    "change_scaling": (st.sampled_from(["upstream", "relative", "probe", "loud"]),),
    "change_waveform": (ids, st.sampled_from([Tone(frequency_hz=33.0), Tap(), None])),
    "clear_inputs": (),
    "copy_clips": (ids, anything, steps_down),
    "cut_clips": (ids,),
    "drag_field": (ids, names, anything),
    "duplicate_clips": (ids,),
    "duplicate_inputs": (ids,),
    "fade_clip": (one_id, anything, anything),
    "group_clips": (ids, st.sampled_from(["sum", "product", "mean"])),
    "insert_time": (anything, anything),
    "join_clips": (ids,),
    "equalise_on_skin": (
        one_id,
        st.lists(st.floats(-200, 200) | st.just(float("-inf")), max_size=5),
        st.text(max_size=5),
    ),
    "level_over": (st.sampled_from(["record", "loudest", "other"]),),
    "look_along": (st.sampled_from(["x", "yz", "xyz", "", "zyx"]),),
    "look_by_method": (st.sampled_from(["mag", "pca", "other"]),),
    "move_clips": (ids, anything, steps_down),
    "move_clips_to_place": (ids, places, switches),
    "forget_snapshot": (numbers,),
    "keep_match_gain": (),
    "match_levels": (st.sampled_from([True, False, None]),),
    "move_inputs": (ids, places),
    "move_marker": (one_id, anything),
    "move_playhead": (anything,),
    "mute_inputs": (ids, switches),
    "paste_fragment": (fragments, anything),
    "place_fragment": (
        fragments,
        st.just("Heartbeat"),
        anything,
        st.none() | one_id,
        st.none() | places,
    ),
    "place_input": (places, switches),
    "place_waveform": (places, st.sampled_from([Tone(), Tap()]), st.sampled_from([0.0, 0.5, -1.0])),
    "play_slower": (anything,),
    "predict_through": (st.none() | st.booleans().map(lambda on: replace(ACTUATION, on=on)),),
    "put_inputs_before": (ids, st.integers(-5, 9)),
    "remove_delay": (switches,),
    "remove_clips": (ids,),
    "remove_inputs": (ids,),
    "remove_marker": (one_id,),
    "remove_time": (anything, anything),
    "rename_marker": (one_id, anything),
    "repeat_clips": (ids, anything),
    "select_all_clips": (),
    "select_clips": (ids,),
    "set_clips": (ids, names, anything),
    "set_gain_curve": (one_id, curves),
    "set_glide_curve": (one_id, st.sampled_from(["frequency", "amplitude", ""]), curves),
    "set_loop": (curves.map(lambda points: points[0] if points else None),),
    "split_clips": (ids, anything),
    "stretch_clip": (one_id, anything, anything),
    "select_all_inputs": (),
    "select_inputs": (ids,),
    "select_outputs": (st.lists(st.integers(0, 73), max_size=4),),
    "select_through": (st.none() | one_id, one_id),
    "show_snapshot": (numbers, st.sampled_from([1.0, 0.3, 1e9, -1.0])),
    "store_snapshot": (numbers,),
    "take_snapshot": (st.sampled_from([Design(limb="synthetic-2"), Design(limb="lab-9")]),),
    "shift_inputs": (ids, switches),
    "solo_inputs": (ids, switches),
    "toggle_clip": (one_id,),
    "toggle_mute": (ids,),
    "toggle_mute_clips": (ids,),
    "toggle_selected": (one_id,),
    "toggle_solo": (ids,),
    "ungroup_clips": (ids,),
    "trim_clip": (one_id, anything, anything),
}
#: What changes the view alone.
LOOKS = {
    "playhead_s": st.floats(0.0, 1.0),
    "time_range_s": st.sampled_from([None, (0.0, 0.5)]),
    "selected_inputs": st.just(()),
    "selected_clips": st.just(()),
}
edit_steps = st.sampled_from(sorted(ARGUMENTS)).flatmap(
    lambda name: st.tuples(st.just(name), st.tuples(*ARGUMENTS[name]), st.sampled_from([None, 5]))
)
look_steps = st.sampled_from(sorted(LOOKS)).flatmap(
    lambda name: st.tuples(st.just("look"), st.tuples(st.just(name), LOOKS[name]), st.none())
)
history_steps = st.tuples(st.sampled_from(["undo", "redo"]), st.just(()), st.none())
steps = st.one_of(edit_steps, edit_steps, edit_steps, look_steps, history_steps)


def test_every_edit_takes_part():
    questions = {"Edit", "Refusal", "fields_of", "kept_selection", "value_of"}
    questions |= {"fragment_from", "fragment_of", "fragment_text"}
    assert ARGUMENTS.keys() == set(edits.__all__) - questions


class History:
    """What a history has to be: for each step, what there was before it and after it."""

    def __init__(self, document):
        self.document, self.stack = document, document.undo_stack
        self.steps, self.done = [], 0

    @property
    def now(self):
        view = self.document.view
        return self.document.design, view.selected_inputs, view.selected_clips, view.outputs

    def do(self, outcome, gesture):
        before, index = self.now, self.stack.index()
        self.document.apply(outcome, gesture)
        if self.stack.count() == self.stack.index():
            # What was taken back before cannot be done again.
            del self.steps[self.done :]
        if self.stack.index() > index:
            self.steps.append([before, self.now])
            self.done += 1
        elif self.stack.index() < index:
            # A gesture that came back to where it began.
            self.steps.pop()
            self.done -= 1
        elif self.done and self.now[0] != before[0]:
            self.steps[-1][1] = self.now

    def undo(self):
        if self.done:
            self.done -= 1
            self.stack.undo()
            assert self.now == self.steps[self.done][0]

    def redo(self):
        if self.done < len(self.steps):
            self.done += 1
            self.stack.redo()
            assert self.now == self.steps[self.done - 1][1]


@settings(max_examples=300, deadline=None, derandomize=True)
@given(sequence=st.lists(steps, max_size=25))
def test_nothing_raises_and_undo_and_redo_bring_back_designs_with_their_selections(qapp, sequence):
    document = Document(START, View(selected_inputs=(2,)))
    history, designs = History(document), []
    document.changed.connect(lambda: designs.append(document.design))
    for name, arguments, gesture in sequence:
        before = len(designs)
        if name == "look":
            document.look(replace(document.view, **dict([arguments])))
        elif name in ("undo", "redo"):
            getattr(history, name)()
        else:
            how = {"lead": 1, "start": START} if name == "drag_field" else {}
            outcome = getattr(edits, name)(document.design, document.view, *arguments, **how)
            history.do(outcome, gesture)
        assert len(designs) - before <= 1, f"{name} was told more than once"
        design = document.design
        assert len(set(design.ids)) == len(design.ids)
        assert 0 not in design.ids
        assert set(document.view.selected_inputs) <= set(design.ids)
        clip_ids = [clip.id for clip in design.clips]
        assert len(set(clip_ids)) == len(clip_ids)
        assert 0 not in clip_ids
        assert set(document.view.selected_clips) <= set(clip_ids)
    while history.done:
        history.undo()
    while history.done < len(history.steps):
        history.redo()
