"""Any sequence of edits: none raises, undo and redo lead to the same states, ids stay unique."""

from dataclasses import replace
from inspect import signature

from hypothesis import given, settings
from hypothesis import strategies as st

from skinsource import Actuation, ActuatorAt, Design, View, actuators, edits, track
from skinsource.actuators.rigs import Rig, RigChannel
from skinsource.base.conventions import LIMB_NAMES
from skinsource.design.effects import EFFECTS
from skinsource.design.motions import MOTIONS, Alternation
from skinsource.design.target import Target
from skinsource.design.waveforms import Noise, Tap, Tone
from skinsource.perception.validity import Finding
from skinsource.specs.samples import Samples
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
DRIVE = Samples(values=[0.0, 1.0, -0.5], sample_rate_hz=1300.0)
RIG = Rig(channels=(RigChannel(place=2, actuator="example-piezo"),))
# Mostly what there is, and now and then what there is not.
likely_id = st.integers(1, 3)
one_id = st.one_of(*(4 * [likely_id]), st.integers(-1, 8))
ids = st.one_of(
    *(4 * [st.lists(likely_id, min_size=1, max_size=3)]), st.lists(one_id, max_size=4)
).map(tuple)
some_time_s = st.floats(0.01, 0.3)
anything = st.one_of(
    *(6 * [some_time_s]),
    st.none(),
    st.booleans(),
    st.integers(),
    st.floats(),
    st.text(max_size=5),
    st.sampled_from([0.1, 1.0, 100.0, "none", "Tone", 2**70]),
)
places, switches = st.integers(-1, 22), st.booleans()
numbers = st.integers(0, 1) | st.integers(-1, 9)
steps_down = st.integers(-1, 1) | st.integers(-3, 3) | anything
curves = st.lists(st.tuples(st.floats(0, 2), st.floats(0, 2)), max_size=3).map(tuple)
findings = st.builds(
    Finding,
    name=st.just("band"),
    state=st.just("left"),
    sentence=st.just(""),
    repair=st.sampled_from(["", "probe_scaling", "quieter", "band_limit", "deselect", "?"]),
    factor=st.floats(0.1, 1.0),
    outputs=st.just((1, 2, 72)),
)
targets = st.sampled_from([Target(strong=(3,)), Target(places=(7,), drives=(DRIVE,)), None])
FIELDS = ("amplitude", "onset_s", "frequency_hz", "duration_s", "seed", "window", "gains_db", "id")
FIELDS_OF_EFFECTS = ("in_s", "times", "factor", "to_s", "points", "on", "low_hz", "")
WAVEFORMS = ("Tone", "Tap", "Impulse", "Noise", "WaveletTrain", "Siren")
#: What is handed to edits after design and view, by the names of their parameters.
BY_NAME = {
    "ids": ids,
    **dict.fromkeys(("id", "clip_id", "input_id", "end"), one_id),
    **dict.fromkeys(("start_s", "end_s", "in_s", "out_s", "time_s", "at_s", "onset_s"), anything),
    **dict.fromkeys(("length_s", "by_s", "value", "times", "slow_motion"), anything),
    **dict.fromkeys(("besides", "copies", "down", "muted", "on", "removed", "solo"), switches),
    **dict.fromkeys(("index", "number", "to"), numbers),
    **dict.fromkeys(("curve", "points"), curves),
    "actuation": st.none() | switches.map(lambda on: replace(ACTUATION, on=on)),
    "axes": st.sampled_from(["x", "yz", "xyz", "", "zyx"]),
    "brush": st.sampled_from(["strong", "quiet", "erase", "select", "loud"]),
    "by_tracks": steps_down,
    "column": st.sampled_from(["frequency", "amplitude", ""]),
    "finding": findings,
    "fragment": st.just(edits.fragment_of(START, (1, 3))),
    "gain": st.sampled_from([1.0, 0.3, 1e9, -1.0]),
    "kind": st.sampled_from([*(kind.__name__ for kind in EFFECTS), *WAVEFORMS, "Echo"]),
    "levels_db": st.lists(st.floats(-200, 200) | st.just(float("-inf")), max_size=5),
    "limb": st.sampled_from([*LIMB_NAMES, "", "other"]),
    "location": places,
    "loop_s": curves.map(lambda points: points[0] if points else None),
    "measure": st.text(max_size=5),
    "method": st.sampled_from(["mag", "pca", "other"]),
    "mode": st.sampled_from(["sum", "product", "mean"]),
    "motion": st.sampled_from([*(kind() for kind in MOTIONS), Alternation(rounds=200), None]),
    "name": st.sampled_from([*FIELDS, *FIELDS_OF_EFFECTS]),
    "other": st.sampled_from([Design(limb="synthetic-2"), Design(limb="lab-9")]),
    "outputs": st.lists(st.integers(0, 73), max_size=4),
    "sample_rate_hz": st.sampled_from([1300.0, 48_000.0]),
    "samples": st.sampled_from([(0.0, 0.5, -1.0), (), (1.0, float("nan"))]),
    "rig": st.none() | st.just(RIG),
    "scaling": st.sampled_from(["upstream", "relative", "probe", "loud"]),
    **dict.fromkeys(("solved", "target"), targets),
    "span": st.sampled_from(["record", "loudest", "other"]),
    "start": st.none() | one_id,
    "waveform": st.sampled_from([Tone(frequency_hz=33.0), Tap(), None]),
}
#: Where one of them may be something else besides.
BESIDES = {
    ("add_waveform", "input_id"): st.none(),
    ("match_tracks", "levels_db"): st.dictionaries(one_id, st.floats(-200, 200), max_size=3),
    ("place_fragment", "input_id"): st.none(),
    ("place_fragment", "location"): st.none(),
    ("rename_marker", "name"): anything,
    ("switch_effect", "on"): anything,
    ("draw_clip", "sample_rate_hz"): st.just(0.0),
}
QUESTIONS = {"Edit", "Refusal", "fields_of", "kept_selection", "value_of"}
QUESTIONS |= {"fragment_from", "fragment_of", "fragment_text"}
EDITS = sorted(set(edits.__all__) - QUESTIONS)


def arguments_of(name):
    """What may be handed to an edit, by its parameters that can be given by position."""
    _, _, *parameters = signature(getattr(edits, name)).parameters.values()
    given = [each.name for each in parameters if each.kind is not each.KEYWORD_ONLY]
    return st.tuples(*(BY_NAME[each] | BESIDES.get((name, each), st.nothing()) for each in given))


#: What changes the view alone.
LOOKS = {
    "playhead_s": st.floats(0.0, 1.0),
    "time_range_s": st.sampled_from([None, (0.0, 0.5)]),
    "selected_inputs": st.just(()),
    "selected_clips": st.just(()),
}
edit_steps = st.sampled_from(EDITS).flatmap(
    lambda name: st.tuples(st.just(name), arguments_of(name), st.sampled_from([None, 5]))
)
look_steps = st.sampled_from(sorted(LOOKS)).flatmap(
    lambda name: st.tuples(st.just("look"), st.tuples(st.just(name), LOOKS[name]), st.none())
)
history_steps = st.tuples(st.sampled_from(["undo", "redo"]), st.just(()), st.none())
steps = st.one_of(edit_steps, edit_steps, edit_steps, look_steps, history_steps)


class History:
    """What a history has to be: for each step, what there was before it and after it."""

    def __init__(self, document):
        self.document, self.stack, self.steps = document, document.undo_stack, []

    @property
    def now(self):
        view = self.document.view
        return self.document.design, view.selected_inputs, view.selected_clips, view.outputs

    def do(self, outcome, gesture):
        index, before = self.stack.index(), self.now
        self.document.apply(outcome, gesture)
        if self.stack.index() > index:
            self.steps[index:] = [[before, self.now]]
        elif (before[0], before[-1]) != (self.now[0], self.now[-1]):
            assert gesture, "an edit is no step of its own"
            self.steps[index - 1][1] = self.now
        del self.steps[self.stack.count() :]

    def go(self, by):
        index = self.stack.index()
        assert self.stack.count() == len(self.steps)
        if 0 <= index + by <= len(self.steps):
            self.stack.setIndex(index + by)
            assert self.now == self.steps[min(index, index + by)][by > 0]


@settings(max_examples=100, deadline=None, derandomize=True)
@given(sequence=st.lists(steps, min_size=20, max_size=40))
def test_nothing_raises_and_undo_and_redo_bring_back_designs_with_their_selections(qapp, sequence):
    document = Document(START, View(selected_inputs=(2,)))
    history, designs = History(document), []
    document.changed.connect(lambda: designs.append(document.design))
    for name, arguments, gesture in sequence:
        before = len(designs)
        if name == "look":
            document.look(replace(document.view, **dict([arguments])))
        elif name in ("undo", "redo"):
            history.go(1 if name == "redo" else -1)
        else:
            how = {"lead": 1, "start": START} if name == "drag_field" else {}
            outcome = getattr(edits, name)(document.design, document.view, *arguments, **how)
            if isinstance(outcome, edits.Refusal):
                assert outcome.sentence.endswith("."), name
                assert len(outcome.sentence) < 400, name
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
    for by in (-1, 1):
        for _ in history.steps:
            history.go(by)
