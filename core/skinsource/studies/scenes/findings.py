"""What a scene shows on the limb that is open, computed there: a sentence with its numbers."""

from collections.abc import Callable
from dataclasses import replace
from functools import partial

import numpy as np
import scipy

from skinsource.base.arrays import Floats
from skinsource.base.decibels import decibels
from skinsource.base.errors import SkinSourceError
from skinsource.design.design import Design
from skinsource.engine.evaluation import evaluate
from skinsource.signals.analysis.noise import LEAST_ABOVE_NOISE_DB
from skinsource.signals.analysis.wave_speed import LEAST_ALIKE, group_delays
from skinsource.studies.scenes.opened_scene import OpenedScene, with_designs

_HIGH_HZ = 200.0


def told(opened: OpenedScene) -> OpenedScene:
    """Return a scene whose sentence ends with what is found on its limb, if anything is."""
    find = FINDINGS.get(opened.scene.name)
    try:
        finding = "" if find is None else find(opened)
    except SkinSourceError:
        # The limb is not here: the window says so.
        finding = ""
    if not finding:
        return opened
    scene = replace(opened.scene, sentence=f"{opened.scene.sentence} {finding}")

    def changed(design: Design) -> Design:
        return replace(design, notes=design.notes.replace(opened.scene.notes, scene.notes, 1))

    return replace(with_designs(opened, changed), scene=scene)


def _at_the_ends(opened: OpenedScene, text: Callable[[Floats, float, int, int], str]) -> str:
    """Return a text on the traces of the first and the last shown output above the noise."""
    results = evaluate(
        opened.design, "selected_traces", "above_noise_db", "sample_rate_hz", view=opened.view
    )
    outputs, above_db = opened.view.outputs, results["above_noise_db"]
    heard = [
        row
        for row, k in enumerate(outputs)
        if above_db is None or above_db[k - 1] >= LEAST_ABOVE_NOISE_DB
    ]
    if len(heard) < 2:
        return ""
    rows = [heard[0], heard[-1]]
    near, far = (outputs[row] for row in rows)
    return text(results["selected_traces"][rows], results["sample_rate_hz"], near, far)


def _power(traces: Floats, rate_hz: float) -> tuple[Floats, Floats]:
    power = np.square(np.abs(scipy.fft.rfft(traces)))
    return scipy.fft.rfftfreq(traces.shape[-1], 1.0 / rate_hz), power / power.sum(axis=1)[:, None]


def _high_frequencies(traces: Floats, rate_hz: float, near: int, far: int) -> str:
    frequency_hz, power = _power(traces, rate_hz)
    at_near, at_far = 100.0 * power[:, frequency_hz > _HIGH_HZ].sum(axis=1)
    return (
        f"Above {_HIGH_HZ:g} Hz lies {at_near:.0f} % of the energy at output {near}, and "
        f"{at_far:.0f} % at output {far}."
    )


def _later_and_weaker(traces: Floats, rate_hz: float, near: int, far: int) -> str:
    peaks = np.abs(scipy.signal.hilbert(traces)).max(axis=1)
    weaker_db = float(-np.diff(decibels(peaks))[0])
    delays_s, alike = group_delays(traces, rate_hz)
    # Where the largest sample of a long tone lies is no time of travel.
    later_ms = 1e3 * float(delays_s[1])
    delay = (
        f", and it comes {abs(later_ms):.0f} ms {'later' if later_ms > 0.0 else 'earlier'} (group "
        "delay)"
    )
    return (
        f"At output {far} its peak is {abs(weaker_db):.0f} dB "
        f"{'weaker' if weaker_db > 0.0 else 'stronger'} than at output {near}"
        f"{delay if alike[1] >= LEAST_ALIKE else ''}."
    )


def _mean_frequencies(traces: Floats, rate_hz: float, near: int, far: int) -> str:
    frequency_hz, power = _power(traces, rate_hz)
    at_near, at_far = power @ frequency_hz
    return (
        f"The mean frequency is {at_near:.0f} Hz at output {near}, and {at_far:.0f} Hz at "
        f"output {far}."
    )


def _interference(opened: OpenedScene) -> str:
    levels_db = np.stack(
        [
            evaluate(condition.design, "output_levels_db", view=opened.view)["output_levels_db"]
            for condition in opened.conditions
        ]
    )
    gains_db = levels_db[-1] - levels_db[:-1].max(axis=0)
    parts = (
        f"{abs(gain_db):.0f} dB {'louder' if gain_db > 0.0 else 'softer'} at output {number}"
        for number in opened.view.outputs[:2]
        for gain_db in [gains_db[number - 1]]
    )
    return (
        f"Along {opened.view.axes}, both are, beside the louder one alone, {' and '.join(parts)}."
    )


def _carried(opened: OpenedScene) -> str:
    """Return a text on the level at the last shown output, on each limb."""
    number = opened.view.outputs[-1]
    parts = []
    for condition in opened.conditions:
        levels_db = evaluate(condition.design, "output_levels_db", view=opened.view)
        own_db = levels_db["output_levels_db"]
        parts.append(f"{condition.label.lower()} {own_db.max() - own_db[number - 1]:.0f} dB")
    return f"At output {number} it is below its maximum by: {', '.join(parts)}."


#: What is computed, by the name of the scene.
FINDINGS: dict[str, Callable[[OpenedScene], str]] = {
    "1D": partial(_at_the_ends, text=_high_frequencies),
    "1G": _carried,
    "2A": partial(_at_the_ends, text=_later_and_weaker),
    "2C": partial(_at_the_ends, text=_mean_frequencies),
    "2F": _interference,
}
