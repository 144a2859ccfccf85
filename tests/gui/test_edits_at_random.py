"""Any sequence of edits: none raises, undo and redo lead to the same states, ids stay unique."""

from hypothesis import given, settings
from hypothesis import strategies as st

from skinsource import edits
from skinsource.design import Design, track
from skinsource.limb import LIMB_NAMES
from skinsource.motions import MOTIONS, Alternation
from skinsource.view import View
from skinsource.waveforms import Noise, Tap, Tone
from skinsource_gui.state.document import Document

START = Design(
    limb="synthetic-1",
    inputs=(
        track(location=7, waveform=Tone()),
        track(location=2, waveform=Noise(), colour=1),
        track(location=2, waveform=Tap(), colour=2),
    ),
)
ids = st.lists(st.integers(-1, 8), max_size=4).map(tuple)
one_id = st.integers(-1, 8)
anything = st.one_of(
    st.none(),
    st.booleans(),
    st.integers(),
    st.floats(),
    st.text(max_size=5),
    st.sampled_from([0.1, 1.0, 100.0, "none", "Tone", 2**70]),
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
switches = st.booleans()
motions = st.sampled_from([*(kind() for kind in MOTIONS), Alternation(rounds=200), None])
#: What is handed to each edit, after design and view.
ARGUMENTS = {
    "add_motion": (
        st.sampled_from([*(kind() for kind in MOTIONS), Alternation(rounds=200), None]),
    ),
    "change_field": (ids, names, anything),
    "change_kind": (
        ids,
        st.sampled_from(["Tone", "Tap", "Impulse", "Noise", "WaveletTrain", "Siren"]),
    ),
    "change_limb": (st.sampled_from([*LIMB_NAMES, "", "other"]),),
    "change_scaling": (st.sampled_from(["upstream", "relative", "probe", "loud"]),),
    "change_waveform": (ids, st.sampled_from([Tone(frequency_hz=33.0), Tap(), None])),
    "clear_inputs": (),
    "drag_field": (ids, names, anything),
    "duplicate_inputs": (ids,),
    "equalise_on_skin": (
        one_id,
        st.lists(st.floats(-200, 200) | st.just(float("-inf")), max_size=5),
        st.text(max_size=5),
    ),
    "level_over": (st.sampled_from(["record", "loudest", "other"]),),
    "look_along": (st.sampled_from(["x", "yz", "xyz", "", "zyx"]),),
    "look_by_method": (st.sampled_from(["mag", "pca", "other"]),),
    "move_inputs": (ids, places),
    "mute_inputs": (ids, switches),
    "place_input": (places, switches),
    "put_inputs_before": (ids, st.integers(-5, 9)),
    "remove_delay": (switches,),
    "remove_inputs": (ids,),
    "select_all_inputs": (),
    "select_inputs": (ids,),
    "select_outputs": (st.lists(st.integers(0, 73), max_size=4),),
    "select_through": (st.none() | one_id, one_id),
    "shift_inputs": (ids, switches),
    "solo_inputs": (ids, switches),
    "toggle_mute": (ids,),
    "toggle_selected": (one_id,),
    "toggle_solo": (ids,),
}
steps = st.sampled_from(sorted(ARGUMENTS)).flatmap(
    lambda name: st.tuples(st.just(name), st.tuples(*ARGUMENTS[name]), st.sampled_from([None, 5]))
)


def test_every_edit_takes_part():
    questions = {"Edit", "Refusal", "fields_of", "kept_selection", "value_of"}
    assert ARGUMENTS.keys() == set(edits.__all__) - questions


def kept(document: Document) -> tuple:
    """What the history brings back."""
    return document.design, document.view.outputs


@settings(max_examples=150, deadline=None, derandomize=True)
@given(sequence=st.lists(steps, max_size=25))
def test_nothing_raises_and_undo_and_redo_lead_through_the_same_states(qapp, sequence):
    document = Document(START, View(selected_inputs=(2,)))
    told = []
    document.changed.connect(lambda: told.append(document.design))
    states = {0: kept(document)}
    for name, arguments, gesture in sequence:
        before = len(told)
        how = {"lead": 1, "start": START} if name == "drag_field" else {}
        outcome = getattr(edits, name)(document.design, document.view, *arguments, **how)
        document.apply(outcome, gesture)
        assert len(told) - before <= 1, f"{name} was told more than once"
        design = document.design
        assert len(set(design.ids)) == len(design.ids)
        assert 0 not in design.ids
        assert set(document.view.selected_inputs) <= set(design.ids)
        states = {k: state for k, state in states.items() if k < document.undo_stack.index()}
        states[document.undo_stack.index()] = kept(document)
    last = document.undo_stack.index()
    for index in range(last, 0, -1):
        assert kept(document) == states[index]
        document.undo_stack.undo()
    assert kept(document) == states[0]
    for index in range(1, last + 1):
        document.undo_stack.redo()
        assert kept(document) == states[index]
