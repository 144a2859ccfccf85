"""The drives of a target: strong outputs play its waveform; figures are those of the map."""

from dataclasses import replace

import numpy as np
import pytest

import skinsource as ss
from skinsource import Design, View, edits
from skinsource.actuators.actuation import Actuation, ActuatorAt
from skinsource.actuators.equalising import RegularisedInverse
from skinsource.actuators.prediction import Limits
from skinsource.actuators.rigs import Rig, RigChannel
from skinsource.base.errors import InvalidInputError
from skinsource.design.target import Target, is_unsolved, target_in
from skinsource.design.waveforms import Formula, Tap, Tone
from skinsource.inverse.aiming import Way, aim, aim_of, margin_of, on_limb, sentences, ways
from skinsource.inverse.focusing import Wish

LIMB = "synthetic-1"
TARGET = Target(strong=(30,), waveform=Tone(100.0, duration_s=0.2))


def solved(target=TARGET, **changes):
    """A design that plays a target."""
    design = Design(limb=LIMB, **changes)
    design = edits.add_motion(design, View(), target).design
    return edits.solve_target(design, View(), aim_of(design).solved(design)).design


def levels_db(design, limb=LIMB):
    design = replace(design, limb=limb)
    return ss.evaluate(design, "output_levels_db", view=View(axes="z"))["output_levels_db"]


def mean_db(levels):
    return 10.0 * np.log10(np.mean(10.0 ** (np.asarray(levels) / 10.0)))


def test_the_strong_output_plays_the_waveform(limb):
    design = solved(replace(TARGET, amplitude=2.0))
    drives = [2.0 * track.clips[0].waveform.samples.values for track in design.inputs]
    places = [track.location for track in design.inputs]
    played = ss.predict(limb, drives, locations=places)[29, 2]
    delay_s = aim(TARGET, limb).focus.delay_s
    first = int(delay_s * limb.sample_rate_hz)
    waveform = np.zeros_like(played)
    wanted = 2.0 * TARGET.waveform.samples(1300.0, delay_s - first / 1300.0)
    waveform[first : first + wanted.size] = wanted
    error = np.square(played - waveform).sum() / np.square(waveform).sum()
    assert 10.0 * np.log10(error) < -25.0


@pytest.mark.parametrize("strong", [(30,), (28, 29, 30)])
def test_figures_are_those_of_the_map(strong):
    target = replace(TARGET, strong=strong, waveform=Tap())
    *_, own = ways(aim_of(design := solved(target)))
    levels = levels_db(design)
    bright = mean_db(levels[[output - 1 for output in strong]])
    others = [output for output in range(1, 43) if output not in strong]
    of_others = levels[[output - 1 for output in others]]
    assert own.loudest == others[int(np.argmax(of_others))]
    assert own.loudest_db == pytest.approx(of_others.max() - bright, abs=0.3)
    assert own.quiet_db == pytest.approx(mean_db(of_others) - bright, abs=0.3)


@pytest.mark.parametrize("strong", [(30,), (28, 29, 30)])
def test_drives_are_found_without_the_unseen_contrast(strong, monkeypatch):
    asked, find = [], Wish.unseen_contrast_db
    monkeypatch.setattr(Wish, "unseen_contrast_db", lambda *given: asked.append(1) or find(*given))
    aimed = aim_of(solved(replace(TARGET, strong=strong)))
    assert not asked
    ways(aimed)
    assert aimed.focus.unseen_contrast_db is aimed.focus.unseen_contrast_db
    assert len(asked) == 1


def test_painted_quiet_outputs_are_quieter_than_where_all_are(limb):
    few = aim(replace(TARGET, quiet=(19, 20)), limb)
    assert ways(few)[2].quiet_db < ways(aim(TARGET, limb))[2].quiet_db - 3.0


def test_velocities_are_those_of_the_probes(limb):
    target = replace(TARGET, amplitude=3.0)
    *_, own = ways(aim(target, limb))
    drives = [track.clips[0].waveform.samples.values for track in solved(target).inputs]
    velocities = np.cumsum(drives, axis=1) * 3.0 / limb.sample_rate_hz
    assert own.velocity_m_per_s == pytest.approx(np.abs(velocities).max(), rel=0.05)


def test_time_reversal_needs_the_least_effort_and_one_input_is_one(limb):
    single, in_time, own = ways(aim(TARGET, limb))
    assert in_time.effort_db == pytest.approx(0.0, abs=1e-9)
    assert single.effort_db > own.effort_db > 0.0
    alone = aim(replace(TARGET, inputs=(7,)), limb)
    assert "Between" not in " ".join(sentences(alone, ways(alone), Design(limb=LIMB)))
    assert [way.quiet_db for way in ways(alone)] == pytest.approx(
        3 * [ways(alone)[0].quiet_db], abs=0.1
    )


def test_as_many_inputs_play_as_are_allowed(limb):
    assert len(aim(replace(TARGET, most=3), limb).places) == 3
    assert set(aim(replace(TARGET, most=3, inputs=(6, 7, 8, 9, 12)), limb).places) <= {
        6,
        7,
        8,
        9,
        12,
    }
    assert aim(replace(TARGET, inputs=(7, 12)), limb).places == (7, 12)


def test_other_people_get_the_same_drives(limb):
    design = solved()
    aimed = aim_of(design)
    other = on_limb(aimed, ss.load_limb("synthetic-2"))
    levels = levels_db(design, "synthetic-2")
    np.testing.assert_allclose(other.levels_db[:42], levels[:42] - levels[29], atol=0.5)
    own = on_limb(aimed, limb)
    assert own.loudest_db == pytest.approx(ways(aimed)[2].loudest_db)


def a_way(**changes):
    figures = {"loudest_db": -5.0, "quiet_db": -12.0, "between_db": -12.0, "effort_db": 1.0}
    figures |= {"contact_db": 3.0, "velocity_m_per_s": 0.01, "amplitude": 1.0}
    return Way(title="", loudest=31, **figures | changes)


ALL = "Between sensors 15 inputs are "


@pytest.mark.parametrize(
    ("single_db", "own", "said"),
    [
        (-8.5, {}, f"{ALL}3.5 dB quieter than the best input."),
        (-9.5, {}, f"{ALL}2.5 dB quieter than the best input: one actuator does nearly as well."),
        (-12.0, {}, f"{ALL}as quiet as the best input: one actuator does as well."),
        (-13.0, {}, f"{ALL}1.0 dB louder than the best input: one actuator does as well."),
        (-8.5, {"quiet_db": -28.0}, "What is quiet is more than 20 dB below in the model."),
        (-8.5, {"velocity_m_per_s": 0.08}, "Not reachable within 40 mm/s: 0.5 m/s² at most."),
    ],
)
def test_what_cannot_be_reached_and_what_is_as_good_is_said(single_db, own, said, limb):
    found = a_way(between_db=single_db), a_way(), a_way(**own)
    told = sentences(aim(TARGET, limb), found, Design(limb=LIMB))
    assert said in told
    assert len(told) == 1 + len(own)


LOUDER = "With this slider position, Digit II, middle phalanx, radial is 3.2 dB louder. "


@pytest.mark.parametrize(
    ("strong", "single_db", "in_time_db", "said"),
    [
        (5, 1.0, 1.0, f"{LOUDER}Move it towards Sharp."),
        (13, 1.0, -1.0, f"{LOUDER}Move it towards Strong."),
        (13, -1.0, 1.0, f"{LOUDER}The best input alone does better."),
        (13, 1.0, 1.0, "Not reachable: Digit IV, middle phalanx, ulnar is 0.1 dB louder at best."),
    ],
)
def test_nothing_is_unreachable_before_all_is_tried(strong, single_db, in_time_db, said, limb):
    found = (a_way(loudest_db=level) for level in (single_db, in_time_db, 3.2))
    aimed = aim(replace(TARGET, strong=(strong,)), limb)
    assert sentences(aimed, tuple(found), Design(limb=LIMB))[0] == said


def test_where_some_are_painted_quiet_the_rest_may_be_louder(limb):
    few = aim(replace(TARGET, quiet=(19, 20)), limb)
    louder = a_way(loudest_db=3.2)
    said = sentences(few, (a_way(between_db=-8.5), a_way(), louder), Design(limb=LIMB))
    assert said == (f"{ALL}3.5 dB quieter than the best input.",)


@pytest.mark.parametrize(
    ("target", "reason"),
    [
        (Target(), "No output is strong"),
        (Target(strong=(80,)), "output"),
        (replace(TARGET, inputs=(25,)), "place"),
        (replace(TARGET, waveform=Formula("0*t", 0.1)), "no energy"),
    ],
)
def test_what_cannot_be_solved_says_why(target, reason, limb):
    with pytest.raises(InvalidInputError, match=reason):
        aim(target, limb)


@pytest.mark.parametrize("scaling", ["upstream", "relative"])
def test_drives_that_are_no_accelerations_are_refused(scaling):
    design = edits.add_motion(Design(limb=LIMB, scaling=scaling), View(), TARGET).design
    with pytest.raises(InvalidInputError, match="scaling Probe acceleration"):
        aim_of(design)


def limited(peak=0.15, **changes):
    return replace(TARGET, amplitude=0.5, peak=peak, **changes)


def test_a_peak_is_kept_and_what_is_reached_is_that_of_the_map():
    free, within = solved(limited(0.0)), solved(limited())
    assert max(np.abs(drive.values).max() for drive in target_in(free)[1].drives) > 0.31
    assert max(np.abs(drive.values).max() for drive in target_in(within)[1].drives) <= 0.3
    *_, own = ways(aim_of(within))
    levels, all_of_it = levels_db(within), levels_db(free)[29]
    assert 20.0 * np.log10(own.amplitude / 0.5) == pytest.approx(levels[29] - all_of_it, abs=0.3)
    others = np.delete(levels[:42], 29)
    assert own.quiet_db == pytest.approx(mean_db(others) - levels[29], abs=0.3)
    assert own.loudest_db == pytest.approx(others.max() - levels[29], abs=0.3)
    said = sentences(aim_of(within), ways(aim_of(within)), within)
    assert said[0] == f"Not reachable within a peak of 0.15 m/s²: {own.amplitude:.2g} m/s² at most."


def test_drives_of_another_level_are_found_again_only_within_a_peak():
    for peak, again in ((0.0, False), (0.15, True)):
        design = solved(limited(peak))
        louder = replace(target_in(design)[1], amplitude=0.6)
        assert is_unsolved(edits.change_target(design, View(), louder).design) == again


COIL = ActuatorAt(model=ss.actuators.load("example-voice-coil"), actuator="example-voice-coil")
DRIVEN = Actuation(actuators=(COIL,), equaliser=RegularisedInverse(), on=False)


@pytest.mark.parametrize(
    "wired",
    [{"full_scale_v": 0.01}, {"limits": Limits(peak_current_a=1e-3)}],
    ids=["full scale", "limit"],
)
def test_limits_of_the_rig_bound_the_level(wired):
    channels = tuple(RigChannel(place=n, output=n, **wired) for n in range(1, 21))
    rigged = {"actuation": DRIVEN, "rig": Rig(channels=channels)}
    design = solved(replace(TARGET, amplitude=20.0), **rigged)
    aimed = aim_of(design)
    margin = margin_of(aimed, design)
    assert margin.factor < 1.0
    told = sentences(aimed, ways(aimed), design)
    most = f"{20.0 * margin.factor:.2g} m/s² at most."
    assert f"Not reachable within the actuator's limits ({margin.words}): {most}" in told
    gentler = solved(replace(TARGET, amplitude=19.9 * margin.factor), **rigged)
    assert margin_of(aim_of(gentler), gentler).factor > 1.0


def test_tracks_beside_the_target_are_counted():
    design = solved(
        inputs=(ss.track(7, Tone()), ss.track(8, Tone()), ss.track(9, Tone(), muted=True))
    )
    aimed = aim_of(design)
    told = sentences(aimed, ways(aimed), design)
    assert told[-1] == "The rows leave out 2 other tracks."
    assert not any("other track" in each for each in sentences(aimed, ways(aimed), solved()))
