"""A calibrated person is verified by playing, and reported."""

import json
from dataclasses import replace
from hashlib import sha256

import numpy as np
import pytest

import skinsource as ss
from skinsource.base.errors import Stopped
from skinsource.lab.calibrating import (
    Sitting,
    StandIn,
    begin_verifying,
    calibrate,
    save_report,
    verify_next,
)
from skinsource.lab.calibrating.report import _page
from skinsource.people.partial_file import digest_of

INPUTS, OTHERS = (8, 12, 16, 20), ("synthetic-2", "synthetic-3")
BURST = ss.waveforms.Tone(frequency_hz=100.0, duration_s=0.3)
SITTING = Sitting(person="p07", like="synthetic-1", output=30, posture="palm down on foam")


def stand_in():
    return StandIn(output=30, inputs=INPUTS)


@pytest.fixture(scope="module")
def begun():
    found = calibrate(SITTING, stand_in())
    focus = ss.people.focus(found.partial, 30, others=OTHERS)
    return begin_verifying(found, focus, BURST, level=0.2, others=OTHERS)


def verified(begun, first=30):
    station, verification = stand_in(), begun
    for output in (first, *begun.places[1:]):
        station.output = output
        verification = verify_next(verification, station)
    return verification


@pytest.fixture(scope="module")
def done(begun):
    return verified(begun)


def test_all_designs_are_as_strong_at_the_target_as_predicted(done):
    checks = done.checks[:3]
    assert [check.played for check in checks] == ["focus", "best single", "time reversal"]
    for check in checks:
        assert check.output == 30
        assert check.predicted_db == pytest.approx(20.0 * np.log10(0.2), abs=0.1)
        assert check.measured_db == pytest.approx(check.predicted_db, abs=0.2)
        assert check.nmse_db < -30.0
        assert abs(check.delay_s) < 1e-4


def test_the_best_single_input_is_the_one_of_most_contrast_on_the_others(begun):
    contrasts = {}
    for place in INPUTS:
        turn = np.exp(-2j * np.pi * begun.focus.frequencies_hz[:, None] / 1300.0 * np.arange(522))
        own = turn @ begun.found.partial.limb.response_to(place)[29, 2]
        hands = [np.delete(ss.load_limb(n).response_to(place)[:42, 2], 29, axis=0) for n in OTHERS]
        quiet = sum(np.square(np.abs(turn @ hand.T)).sum() for hand in hands)
        contrasts[place] = np.square(np.abs(own)).sum() / quiet
    (track,) = begun.designs["best single"].inputs
    assert track.location == max(contrasts, key=contrasts.get)


def test_it_is_verified_at_the_loudest_other_place_and_at_one_in_the_middle(begun, done):
    levels_db = begun.expected["focus"].mean_db[:42]
    target, loudest, middle = begun.places
    assert target == 30
    assert loudest == np.delete(np.arange(1, 43), 29)[np.delete(levels_db, 29).argmax()]
    assert (levels_db > levels_db[middle - 1]).sum() == pytest.approx(21, abs=1)
    assert begun.state == "not verified"
    assert done.state == "verified"
    assert [check.output for check in done.checks[::3]] == [*begun.places]
    for check in done.checks[3:]:
        assert check.low_db < check.predicted_db < check.high_db
        assert np.isnan(check.nmse_db)


def test_the_sensor_tells_what_the_stand_in_does_there(done):
    station, check = stand_in(), done.checks[-3]
    sent = ss.stimulus_of(done.designs["focus"])
    places = [channel.place for channel in sent.channels]
    gains = [station.errors[place][0] for place in places]
    row = ss.predict(station.limb, sent.samples, places, gains)[check.output - 1, 2]
    level = np.sqrt(np.convolve(row**2, np.ones(130)).max() / 130)
    assert check.measured_db == pytest.approx(20.0 * np.log10(level), abs=1.0)


def test_channels_wait_for_one_that_is_known_to_be_late(begun):
    station = stand_in()
    first, *rest = station.rig.channels
    station.__dict__["rig"] = replace(station.rig, channels=(replace(first, delay_s=0.003), *rest))
    gain, late_s = station.errors[8]
    station.errors[8] = gain, late_s + 0.003
    for check in verify_next(begun, station).checks:
        assert check.nmse_db < -30.0
        assert abs(check.delay_s) < 1e-4


@pytest.mark.parametrize(
    ("middle_db", "said"),
    [
        (-20.0, "2.0 dB below the target. It is 3.1 dB quieter there"),
        (-9.0, "1.0 dB above the target. It is 2.5 dB louder there"),
    ],
)
def test_the_louder_quiet_place_is_compared_with_target_and_best_single_input(
    done, middle_db, said
):
    levels_db = -10.0, -10.5, 0.0, -12.0, -9.4, 0.0, middle_db, -12.0, 0.0
    pairs = zip(done.checks, levels_db, strict=True)
    checks = tuple(replace(check, measured_db=level_db) for check, level_db in pairs)
    assert said in replace(done, checks=checks).words


def test_a_sensor_elsewhere_than_at_the_target_differs(begun):
    assert verified(begun, first=9).state == "differs"


def test_a_quiet_place_that_is_stronger_than_on_anybody_else_differs(begun):
    expected = begun.expected["focus"]
    low = replace(expected, high_db=expected.high_db - 30.0)
    quieter = replace(begun, expected={**begun.expected, "focus": low})
    assert verified(quieter).state == "differs"


def test_it_holds_for_its_own_measurement_alone(begun):
    assert begun.holds_for(begun.found.partial)
    assert not begun.holds_for(
        calibrate(SITTING, StandIn(output=30, inputs=INPUTS, seed=1)).partial
    )


def test_stop_answers_while_it_is_begun_or_verified(begun):
    with pytest.raises(Stopped):
        begin_verifying(begun.found, begun.focus, BURST, others=OTHERS, stop=lambda: True)
    with pytest.raises(Stopped):
        verify_next(begun, stand_in(), stop=lambda: True)


def test_the_report_says_what_was_measured_and_how(done, tmp_path):
    (tmp_path / "mine").mkdir()
    about = save_report(tmp_path, done)
    read = json.loads((tmp_path / "report.json").read_text("utf-8"))
    assert read["state"] == "verified"
    assert read["sitting"]["posture"] == "palm down on foam"
    assert [each["place"] for each in read["inputs"]] == [*INPUTS]
    assert len(read["rules_of_exclusion"]) == 4
    assert read["focus"]["other_people"] == [*OTHERS]
    assert read["checks"][0]["measured_db"] == done.checks[0].measured_db
    assert read["checks"][0]["low_db"] is None
    assert "seed 0" in read["rig"]
    assert {*read["played"]} == {"focus", "best single", "time reversal"}
    assert read["sha256_of_partial_limb"] == digest_of(done.found.partial)
    for name, digest in read["files"].items():
        assert sha256((tmp_path / name).read_bytes()).hexdigest() == digest
    assert {"person.h5", "focus.wav", "best-single.wav.json"} <= {*read["files"]}
    sidecar = (tmp_path / "time-reversal.wav.json").read_text("utf-8")
    assert "Time reversal at output 30 of p07" in sidecar
    assert "Focus on" not in sidecar
    page = " ".join(text.get_text() for text in _page(about, done).texts)
    assert f"SHA-256 of person.h5: {read['files']['person.h5']}." in page
    assert (tmp_path / "report.pdf").read_bytes().startswith(b"%PDF")
    assert about["state"] == read["state"]


def test_a_report_before_the_checks_says_so_and_names_what_was_left_out(begun, tmp_path):
    rows = (replace(begun.found.rows[0], failures=("It came off.",)), *begun.found.rows[1:])
    about = save_report(tmp_path, replace(begun, found=replace(begun.found, rows=rows)))
    assert about["state"] == "not verified"
    assert about["inputs"][0]["failures"] == ("It came off.",)


@pytest.mark.parametrize(("claimed", "lies_on"), [(30, 30), (30, 18), (9, 9)])
def test_it_can_be_told_where_the_sensor_of_the_stand_in_lay(claimed, lies_on):
    station = StandIn(output=lies_on)
    found = calibrate(replace(SITTING, output=claimed), station)
    assert found.accepted
    said = ss.people.likeliest_place(found.partial, claimed, station.others)
    assert (said == claimed) == (claimed == lies_on)
