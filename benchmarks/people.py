"""What is promised about a hand that was not measured: trials that leave each person out in turn.

    python benchmarks/people.py docs/people.md

needs the measured limbs (`skinsource dataset fetch`), and takes about a minute.
"""

import sys
from collections.abc import Iterator, Sequence
from pathlib import Path

import numpy as np

from skinsource.base.conventions import Complexes, Floats, Integers
from skinsource.base.files import write_bytes
from skinsource.design.comparing import half_width_db
from skinsource.inverse.focusing import loaded, target_row
from skinsource.inverse.responses import (
    HAND_OUTPUTS,
    Responses,
    bins_of,
    gram_of,
    n_fft_of,
    responses_of,
)
from skinsource.limbs.limb import Limb
from skinsource.people.carrying import carried, far_apart
from skinsource.people.likeness import MARGIN, probably_on, unlikeness
from skinsource.people.others import band_levels_db, people_of
from skinsource.people.trials import held_text, range_held

N_HAND = len(HAND_OUTPUTS)
ALL = tuple(range(1, 21))
#: Of the simulated rig: noise under the row, largest error of gains, and of delays.
NOISE_DB, GAIN_DB, DELAY_S, SEEDS = 20.0, 3.0, 1e-4, range(10)
_BAND_HZ, _BINS = (30.0, 300.0), 30


def usual_bins_hz(limb: Limb) -> Floats:
    """Return 30 frequencies from 30 to 300 Hz, (n_bins,)."""
    all_hz = bins_of(n_fft_of(limb.n_taps), limb.sample_rate_hz)
    at_hz = all_hz[(all_hz >= _BAND_HZ[0]) & (all_hz <= _BAND_HZ[1])]
    return at_hz[np.linspace(0, at_hz.size - 1, _BINS).round().astype(int)]


def focus_trial(
    people: Sequence[Limb],
    *,
    axes: str = "z",
    inputs: Sequence[int] = ALL,
    frequencies_hz: Floats | None = None,
    placed: Integers | None = None,
    steady: bool = True,
) -> dict[str, Floats]:
    """Return contrasts on the person left out, (n_people, n_targets, n_seeds), in dB.

    Of the person's own row with the others' quiet matrix, and the loudest other output then; of
    time reversal of that row; of the best single input of the others, and by hindsight.

    Parameters
    ----------
    placed : (n_targets,), optional
        Row of the output that the sensor really was on, from 0, where it is another one.
    steady
        Whether the errors of gains and delays were there when the row was measured.
    """
    at_hz = usual_bins_hz(people[0]) if frequencies_hz is None else frequencies_hz
    answers = [responses_of(p, axes=axes, inputs=inputs, frequencies_hz=at_hz) for p in people]
    everything = np.stack([gram_of(each.rows(HAND_OUTPUTS)) for each in answers])
    found: dict[str, list[Floats]] = {name: [] for name in _COLUMNS}
    for person, own in enumerate(answers):
        hand = own.rows(HAND_OUTPUTS)
        for target in HAND_OUTPUTS:
            strong = np.stack([gram_of(each.rows([target])) for each in answers])
            quiet = everything - strong
            singles_db = _contrast_db(_diagonal(strong), _diagonal(quiet))
            of_others = np.delete(singles_db, person, axis=0).mean(axis=0).argmax()
            sensor = target if placed is None else int(placed[target - 1]) + 1
            known = np.delete(quiet, person, axis=0).mean(axis=0)
            focused, reversed_in_time = [], []
            for row, errors in _measured(own, sensor, steady):
                weight = np.square(np.abs(row)).sum(axis=1, keepdims=True)
                focused.append(weight * loaded(row, known)[0] * errors)
                reversed_in_time.append(row.conj() * errors)
            mean_db, loudest_db = _seen(hand, target, focused)
            reversed_db, _ = _seen(hand, target, reversed_in_time)
            singles = singles_db[person, of_others], singles_db[person].max()
            values = mean_db, loudest_db, reversed_db, *singles
            for name, value in zip(_COLUMNS, values, strict=True):
                found[name].append(np.broadcast_to(value, len(SEEDS)))
    shape = len(people), N_HAND, len(SEEDS)
    return {name: np.reshape(values, shape) for name, values in found.items()}


_COLUMNS = "own row", "loudest other", "time reversal", "best single", "by hindsight"


def _measured(own: Responses, sensor: int, steady: bool) -> Iterator[tuple[Complexes, Complexes]]:
    """Yield the row as the rig measures it, and the errors with which it then plays, by seed."""
    row = target_row(own, sensor)
    size = np.sqrt(np.mean(np.square(np.abs(row))) / 2.0) * 10.0 ** (-NOISE_DB / 20.0)
    for seed in SEEDS:
        random = np.random.default_rng(seed)
        noise = size * (random.normal(size=row.shape) + 1j * random.normal(size=row.shape))
        gains = 10.0 ** (random.uniform(-GAIN_DB, GAIN_DB, row.shape[1]) / 20.0)
        delays_s = random.uniform(-DELAY_S, DELAY_S, row.shape[1])
        errors = gains * np.exp(-2j * np.pi * own.frequencies_hz[:, None] * delays_s)
        yield row * (errors if steady else 1.0) + noise, errors


def _seen(hand: Complexes, target: int, drives: Sequence[Complexes]) -> tuple[Floats, Floats]:
    """Return the target's energy over the mean of the others, and over the loudest, by seed, dB."""
    field = hand @ np.stack(drives, axis=-1)
    energy = np.square(np.abs(field)).sum(axis=0).reshape(N_HAND, -1, len(drives)).sum(axis=1)
    others, strong = np.delete(energy, target - 1, axis=0), energy[target - 1]
    return _contrast_db(strong, others.sum(axis=0)), 10.0 * np.log10(strong / others.max(axis=0))


def _diagonal(grams: Complexes) -> Floats:
    """Return the energy of each input alone, (n_people, n_used)."""
    return np.einsum("pfii->pi", grams).real


def _contrast_db(strong: Floats, quiet: Floats) -> Floats:
    return 10.0 * np.log10((N_HAND - 1) * strong / quiet)


def octaves_of(people: Sequence[Limb]) -> Floats:
    """Return octave levels on the hand, (n_people, n_octaves, 42, 20), in dB."""
    return np.stack([band_levels_db(limb, ALL)[:, :N_HAND] for limb in people])


def levels_trial(levels_db: Floats, count: int) -> tuple[Floats, Floats]:
    """Return errors with ``count`` own places, (n_people, n_octaves, 42, 20), in dB, and held.

    What the range of the person's own places held is a share of the levels elsewhere, (n_people,).
    """
    errors, held = np.empty_like(levels_db), []
    for person, own_db in enumerate(levels_db):
        others_db = np.delete(levels_db, person, axis=0)
        rows = far_apart(others_db.mean(axis=0), count) if count else []
        elsewhere = np.delete(np.arange(N_HAND), rows)
        shares = []
        for octave, theirs_db in enumerate(np.moveaxis(others_db, 1, 0)):
            mean_db, half_db = theirs_db.mean(axis=0), half_width_db(theirs_db)
            if rows:
                mean_db, remaining = carried(theirs_db, own_db[octave, rows], rows, range(len(ALL)))
                half_db = half_db * remaining[elsewhere]
            errors[person, octave] = mean_db - own_db[octave]
            shares.append(np.abs(errors[person, octave, elsewhere]) <= half_db)
        held.append(np.mean(shares))
    return errors, np.array(held)


def neighbours(limb: Limb) -> Integers:
    """Return the output that is nearest to each one of the hand, from 0, (42,)."""
    places = limb.output_positions_mm[:N_HAND]
    apart = np.hypot(*np.moveaxis(places[:, None] - places, 2, 0))
    np.fill_diagonal(apart, np.inf)
    return apart.argmin(axis=1)


def places_trial(
    levels_db: Floats, nearest: Integers, margin: float = MARGIN
) -> tuple[Floats, Floats]:
    """Return false alarms and hits of a sensor on the nearest wrong place, (n_people, 42)."""
    alarms, hits = [], []
    claimed = np.arange(N_HAND)
    for person, own_db in enumerate(levels_db):
        unlike = unlikeness(own_db, np.delete(levels_db, person, axis=0))
        alarms.append([probably_on(unlike[k], k, margin) != k for k in claimed])
        hits.append([probably_on(unlike[nearest[k]], k, margin) != k for k in claimed])
    return np.array(alarms), np.array(hits)


def _counts(values: Floats) -> str:
    return ", ".join(str(int(count)) for count in values.sum(axis=1))


def page() -> str:
    """Return the page with the numbers of all trials."""
    people = people_of(None, 3)
    five, other_eight, eight = ALL[5:10], ALL[5::2], ALL[5:13]
    rigs = {
        "z, all 20 inputs": {},
        "three axes, all 20 inputs": {"axes": "xyz"},
        "z, the 15 perpendicular inputs (6 to 20)": {"inputs": ALL[5:]},
        "z, 8 inputs (6, 8, 10 to 20)": {"inputs": other_eight},
        "z, 8 inputs (6 to 13)": {"inputs": eight},
        "z, five finger pads (6 to 10)": {"inputs": five},
    }
    rigs |= {
        f"five finger pads, a tone of {hz:g} Hz": {
            "inputs": five,
            "frequencies_hz": np.array([hz]),
        }
        for hz in (100.0, 200.0, 300.0)
    }
    nearest = neighbours(people[0])
    rigs["z, all 20 inputs, sensor on the nearest wrong place"] = {"placed": nearest}
    rigs["z, all 20 inputs, errors that came after measuring"] = {"steady": False}
    rows = []
    for name, rig in rigs.items():
        found = focus_trial(people, **rig)
        medians = (f"{np.median(found[column]):.1f}" for column in _COLUMNS[:-1])
        rows.append(f"| {name} | {' | '.join(medians)} |")
    levels_db = octaves_of(people)
    carried_rows = []
    for count in (0, 1, 2, 4, 8, 12):
        errors, held = levels_trial(levels_db, count)
        rms = np.sqrt(np.square(errors).mean())
        shares = ", ".join(f"{100 * share:.0f}" for share in held)
        carried_rows.append(
            f"| {count} | {rms:.1f} | {np.quantile(np.abs(errors), 0.9):.1f} | {shares} |"
        )
    alarms, hits = places_trial(levels_db, nearest)
    return _PAGE.format(
        focus="\n".join(rows),
        levels="\n".join(carried_rows),
        held=held_text(range_held()),
        alarms=_counts(alarms),
        hits=_counts(hits),
        n=N_HAND,
    )


_PAGE = """\
# Another hand

You design on the hand of somebody who was measured, and your participant has another one. How much
stronger or weaker is it there? And how does one place become strong on *that* hand? `ss.people`
answers both.

## How far levels differ

In the window, **View > Compare side by side** with *Limbs* and *Range* shows mean and both ends.
In the first word above the skin map, *Range between people* shows the mean, with the ends under the
pointer. In a script:

```python
import skinsource as ss

tone = ss.waveforms.Tone(frequency_hz=100.0, duration_s=0.2)
design = ss.Design(limb="synthetic-1", inputs=(ss.track(7, tone),))
others = ["synthetic-2", "synthetic-3", "synthetic-4"]  # left out: the four measured people
found = ss.people.levels(design, limbs=others)
print(f"output 29: {{found.low_db[28]:.1f}} to {{found.high_db[28]:.1f}} dB re 1 m/s²")
```

```text
output 29: -13.5 to 2.6 dB re 1 m/s²
```

`skinsource export --people` writes the range into the sidecar, and a [sweep](sweeps.md) with
`people = true` into its table.

## A focus on one person, in three steps

You need a [rig](rigs.md) and an accelerometer of at most 0.5 g. To try it without both, choose
*Stand-in person*. Open **Play > Calibrate a person…**

1. **Mounting.** Fix the actuators, and the sensor where the skin should be strong. Press *Start*.
2. **Sweeps.** Each actuator plays two. *Repeat failed* measures again what was not accepted.
   *Focus here* makes a design that is strong at the sensor and quiet elsewhere; what other places
   do, it takes from the measured people.
3. **Focus.** *Verify* plays it and compares the sensor with the prediction, there and at two quiet
   places. Before that, and after mounting anew, the focus is not verified.

*Save…* writes the person to a file. *Open person…* reads it, and so does a script:

```python
own = ss.people.partial("synthetic-1", [9])  # in place of ss.people.open_partial("p07.h5")
focus = ss.people.focus(own, 9, others=others)
design = focus.design(tone)
print(f"looks like output {{ss.people.likeliest_place(own, 9, others)}}")
```

```text
looks like output 9
```

A sensor on the wrong place costs all of the gain: `likeliest_place` says where it probably lies.

Levels are known better with more places measured: `ss.people.levels(design, own=own)`.
`ss.people.suggested_places` names the places that help most.

## Numbers

They are of the four measured people: each is left out in turn and predicted from the three others,
at {n} outputs of the hand.

**Levels.** The range is ±1.645 s √(1 + 1/n) around the mean of n people; s² is the variance between
them, pooled over the hand. It is no confidence band. It held these shares of the levels, from 20
places:

{held}

**A focus from one place.** *Focus* is the energy at the target over the mean of the other 41
outputs, *loudest other* over the loudest of them, in dB: 30 to 300 Hz, natural spectrum, medians
over people, targets and ten rigs that are made up. Their noise is 20 dB below the responses, gains
are wrong by up to 3 dB and delays by up to 0.1 ms. *Time reversal* knows the person alone, *best
single* the others alone.

| rig | focus | loudest other | time reversal | best single |
|---|---|---|---|---|
{focus}

So most of the gain is what was measured of the person. Five finger pads gain nothing at 200 and
300 Hz. Some other output is about as loud as the target, and with few inputs louder.

**A sensor on the wrong place.** Of {n} sensors on each person, `likeliest_place` doubted {alarms}
on the right place, and {hits} on the nearest wrong one.

**More places measured.** Errors of octave levels over the hand, 20 inputs. A Gaussian process
carries what was measured to the rest of the hand:

| own places | rms, dB | 90 % within, dB | held of each person elsewhere, % |
|---|---|---|---|
{levels}

## Limits

- **Four people are no population.** They had one posture, and inputs were measured one at a time.
  Kernels, weights, β and margins were chosen on the same four people.
- 66 of 72 sensors lie on the back of hand and arm: nothing is known of the skin of the palm.
- Where nothing was measured of the person, phases cannot be predicted: there is no trace and no
  focus.

## What is promised

| what | leaving one person out |
|---|---|
| focus from one place, 20 inputs, z | 11.5 dB or more, 3.5 dB over the best single |
| the same, three axes | 9.5 dB or more |
| the same, 8 inputs, z | 7 dB or more |
| levels with 4, 8, 12 own places | at most 3.7, 3.3, 3.1 dB rms |

They are medians over all people left out, and rms over all of them; no person is more than 1 dB
below the first three. `tests/core/people/test_promises.py` holds them.
`python benchmarks/people.py docs/people.md` writes this page.
"""


if __name__ == "__main__":
    write_bytes(Path(sys.argv[1]), page().encode())
