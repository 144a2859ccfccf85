"""What goes with a result wherever it is taken."""

import re

import numpy as np
import pytest

import skinsource as ss
from skinsource.engine.evaluation import evaluate
from skinsource.perception.validity import (
    Finding,
    Judged,
    drive_findings,
    in_full,
    in_short,
    noise_findings,
)

FAST = Finding(name="drive", state="left", sentence="Fast, and more.", in_short="Fast.")
HALF, MOST = (
    Finding(
        name="band", state="left", sentence="Some.", in_short="It is {:.0%} outside.", number=share
    )
    for share in (0.5, 0.9)
)
UNKNOWN = Finding(name="noise", state="unknown", sentence="Nobody knows")
KEPT = Finding(name="band", state="kept", sentence="Fine.")
NOTE = "made from other files"


def test_notes_and_what_is_not_kept_are_said_in_short_and_what_is_unknown_only_in_full():
    judged = Judged(label="A", note=NOTE, findings=(FAST, UNKNOWN, KEPT))
    assert in_short([judged]) == ("Made from other files.", "Fast.")
    assert in_full([judged]) == (
        "NOTE on the limb: made from other files",
        "validity, drive: CAUTION: Fast, and more.",
        "validity, noise: unknown: Nobody knows",
    )
    assert in_short([Judged(label="A", findings=(KEPT,))]) == ()


def test_what_holds_for_several_is_said_once_with_who_they_are_and_for_all_without():
    several = [
        Judged(label="A", note=NOTE, findings=(FAST,)),
        Judged(label="B", findings=(FAST,)),
        Judged(label="C", note=NOTE, findings=(FAST,)),
    ]
    assert in_short(several) == ("A, C: Made from other files.", "Fast.")
    several[1] = Judged(label="B", findings=(KEPT,))
    assert in_short(several) == ("A, C: Made from other files.", "A, C: Fast.")


def test_numbers_that_differ_between_designs_are_a_range():
    several = [Judged(label="A", findings=(MOST,)), Judged(label="B", findings=(HALF,))]
    assert in_short(several) == ("It is 50% to 90% outside.",)
    assert in_short([*several, Judged(label="C", findings=())]) == (
        "A, B: It is 50% to 90% outside.",
    )
    assert in_short(several[:1]) == ("It is 90% outside.",)
    # A note may hold anything.
    assert in_short([Judged(label="A", note="a {:.0%} b", findings=())]) == ("A {:.0%} b.",)


def test_what_was_not_judged_says_so():
    text = "hether conditions of the measurement are kept was not judged"
    assert in_short([Judged(label="A")]) == (f"W{text}.",)
    assert in_full([Judged(label="A")]) == (f"validity: w{text}",)


@pytest.mark.parametrize("scaling", ["probe", "upstream"])
def test_each_condition_that_is_not_kept_has_short_words_and_no_other(scaling):
    waveforms = ss.waveforms.Tone(frequency_hz=400.0), ss.waveforms.Tone(frequency_hz=10.0)
    inputs = tuple(
        ss.track(place, waveform, amplitude=90.0) for place, waveform in enumerate(waveforms, 7)
    )
    design = ss.Design(limb="synthetic-1", scaling=scaling, inputs=inputs)
    findings = evaluate(design, "validity")["validity"]
    left = {finding.name for finding in findings if finding.state == "left"}
    assert left >= {"band", "spacing", "limb", "drive" if scaling == "probe" else "scaling"}
    for finding in findings:
        assert bool(finding.in_short) == (finding.state == "left")
        assert (finding.number is None) == ("{" not in finding.in_short)
        assert len(finding.in_short) <= 100
    short = " ".join(in_short([Judged(label="A", findings=findings)]))
    assert "{" not in short
    assert " of the energy lies above 300 Hz" in short


def test_short_words_hold_the_number_of_the_sentence():
    time_s = np.arange(1300) / 1300.0
    loud = 90.0 * np.sin(800.0 * np.pi * time_s) + 30.0 * np.sin(20.0 * np.pi * time_s)
    findings = [
        *drive_findings([(7, loud)], 1300.0, "probe"),
        noise_findings(np.array([3.0, 9.0, 9.0, 9.0]), synthetic=False, silent=False),
    ]
    assert [finding.name for finding in findings if finding.number is not None] == [
        "band",
        "drive",
        "spacing",
        "noise",
    ]
    for finding in findings:
        sentence = finding.in_short.format(finding.number)
        assert (
            re.findall(r"\d[\d.]*%?", sentence)[0] == re.findall(r"\d[\d.]*%?", finding.sentence)[0]
        )


def test_what_lies_between_outputs_is_told_of_maps_alone():
    map_alone = Finding(name="spacing", state="left", sentence="", in_short="G.", of_maps=True)
    judged = Judged(label="A", findings=(FAST, map_alone))
    assert in_short([judged]) == ("Fast.", "G.")
    assert in_short([judged.without_maps()]) == ("Fast.",)
    assert Judged(label="A").without_maps() == Judged(label="A")
