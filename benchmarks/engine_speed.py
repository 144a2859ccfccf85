"""What an edit costs, as a ratio to computing everything anew with ``scipy.signal.fftconvolve``.

Twenty inputs of 1 s, of one clip or of ten; after each edit the map of all 72 outputs, six traces
and six spectra in three axes each.  The plain way convolves every input with all 216 responses,
takes the maximum, sums, and takes RMS, traces and spectra.  Both ways run in turn in one process,
in float64; medians of the ratios of the rounds.

An edit of a target, a tap at one output with twenty inputs, finds its drives as well: it may cost
twice as much as one of all waveforms.

    python benchmarks/engine_speed.py [--rounds 15] [--long]
"""

import argparse
import platform
import statistics
import sys
from collections.abc import Callable
from dataclasses import replace
from time import perf_counter

import numpy as np
from scipy.signal import fftconvolve

from skinsource.base.allocation import keep_freed_memory
from skinsource.design.clips import Clip
from skinsource.design.design import Design, Input, View, track
from skinsource.design.edits import add_motion, change_target, solve_target
from skinsource.design.target import Target, is_unsolved
from skinsource.design.waveforms.pulses import Noise, Tap
from skinsource.design.waveforms.tones import Tone
from skinsource.engine.prediction import predict
from skinsource.engine.quantities import new_graph, sources
from skinsource.inverse.aiming import aim_of
from skinsource.limbs.catalog import default_limb, load_limb

#: Edits come as drags: so many different ones after each plain pass, of which the mean counts.
DRAG_STEPS = 10
OUTPUTS = (29, 30, 33, 35, 38, 52)
WANTED = frozenset({"output_rms", "axis_traces", "axis_spectra"})
PROMISED = {
    "amplitude of one input": 150,
    "onset of one input": 60,
    "waveform of one input": 40,
    "one of ten clips of one": 40,
    "all 20 waveforms": 6,
    "a target of 20 inputs": 3,
    "axes": 75,
    "method": 75,
    "one more output": 75,
}

Edit = Callable[[Design, View, int], tuple[Design, View]]


def twenty_inputs() -> tuple[Input, ...]:
    """Tones, noise and taps at the twenty places, all as long as 1 s."""
    kinds = (
        lambda k: Tone(frequency_hz=40.0 + 25.0 * k, duration_s=1.0),
        lambda k: Noise(seed=k, duration_s=1.0),
        lambda k: Tone(frequency_hz=600.0 - 25.0 * k, duration_s=1.0, window="hanning"),
        lambda k: Tap(),
    )
    return tuple(
        track(
            location=k + 1,
            waveform=kinds[k % 4](k),
            amplitude=0.5 + 0.1 * k,
            onset_s=0.05 if k == 10 else 0.0,
            colour=k,
        )
        for k in range(20)
    )


def a_target(beta: float = 0.3) -> Target:
    """A tap at one output, which has energy in all of the band."""
    return Target(strong=(30,), waveform=Tap(), inputs=tuple(range(1, 21)), beta=beta)


def with_drives(design: Design, view: View) -> Design:
    """Return a design with the drives of its target, if it has one."""
    if not is_unsolved(design):
        return design
    return solve_target(design, view, aim_of(design).solved(design)).design


def ten_clips_each() -> tuple[Input, ...]:
    """Twenty tracks of ten clips, one after the other, in 1 s."""

    def clip(k: int, place: int) -> Clip:
        tone = Tone(frequency_hz=40.0 + 25.0 * k + 3 * place, duration_s=0.1)
        return Clip(waveform=tone, onset_s=0.1 * place, gain=0.5 + 0.1 * place)

    return tuple(
        Input(
            location=k + 1,
            clips=tuple(clip(k, place) for place in range(10)),
            amplitude=0.5 + 0.1 * k,
            colour=k,
        )
        for k in range(20)
    )


def edits() -> dict[str, Edit]:
    """Each edit of the table, as a function of the round."""

    def waveform(track: Input, k: int) -> Input:
        [clip] = track.clips
        if isinstance(clip.waveform, Noise):
            new = replace(clip.waveform, seed=1000 + k + track.location)
        elif isinstance(clip.waveform, Tone):
            new = replace(clip.waveform, frequency_hz=60.0 + k + track.location)
        else:
            new = Noise(seed=2000 + k + track.location, duration_s=0.05)
        return replace(track, clips=(replace(clip, waveform=new),))

    return {
        "amplitude of one input": lambda d, v, k: (d.with_input(4, amplitude=1.0 + 0.01 * k), v),
        "onset of one input": lambda d, v, k: (d.with_clip(5, onset_s=(1 + k % 50) / 1300.0), v),
        "waveform of one input": lambda d, v, k: (
            d.with_clip(5, waveform=Tone(frequency_hz=100.0 + k, duration_s=1.0)),
            v,
        ),
        "one of ten clips of one": lambda d, v, k: (
            d.with_clip(45, onset_s=(390 + k % 50) / 1300.0),
            v,
        ),
        "all 20 waveforms": lambda d, v, k: (
            replace(d, inputs=tuple(waveform(track, k) for track in d.inputs)),
            v,
        ),
        "a target of 20 inputs": lambda d, v, k: (
            change_target(d, v, a_target(beta=0.1 + 0.01 * k)).design,
            v,
        ),
        "axes": lambda d, v, k: (d, replace(v, axes=("z", "xyz")[k % 2])),
        "method": lambda d, v, k: (d, replace(v, method=("pca", "mag", "rms", "soc")[k % 4])),
        "one more output": lambda d, v, k: (d, replace(v, outputs=(*OUTPUTS[:5], 53 + k % 10))),
    }


def plainly(design: Design, view: View) -> None:
    """Compute everything anew."""
    limb = load_limb(design.limb) if plainly.limb is None else plainly.limb
    total = 0.0
    n_times = max(round((clip.onset_s + clip.duration_s) * 1300) for clip in design.clips)
    for input_track in design.inputs:
        drive = np.zeros(n_times)
        for clip in input_track.clips:
            samples = clip.waveform.samples(1300.0)
            start = round(clip.onset_s * 1300)
            drive[start : start + samples.size] += clip.gain * samples[: n_times - start]
        response = plainly.responses[input_track.location]
        field = fftconvolve(response, drive[:, None, None], axes=0)
        total = total + field * (input_track.amplitude / field.max())
    del limb
    rms = np.sqrt(np.mean(np.sum(total**2, axis=2), axis=0))
    traces = total[:, [output - 1 for output in view.outputs]].transpose(1, 2, 0)
    spectra = np.abs(np.fft.rfft(traces)) / traces.shape[-1]
    plainly.result = rms, traces, spectra


def main() -> int:
    """Print the table; 1 if a promise is broken."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--rounds", type=int, default=15)
    parser.add_argument("--long", action="store_true", help="also 60 s, streamed")
    options = parser.parse_args()
    # As the studio does at its start; the plain way gains as much from it.
    keep_freed_memory()
    name = default_limb()
    plainly.limb = load_limb(name)
    # Upstream's own arrangement: time first.
    plainly.responses = {
        k: np.ascontiguousarray(plainly.limb.response_to(k).transpose(2, 0, 1))
        for k in range(1, 21)
    }
    print(f"{platform.platform()}, Python {platform.python_version()}, numpy {np.__version__}")
    print(f"{name}, 20 inputs of 1 s, float64; ms are medians, ratios medians of {options.rounds}")
    print(f"{'edit':>24} {'plain':>8} {'studio':>8} {'ratio':>7} {'promised':>9}")
    broken = 0
    for label, edit in edits().items():
        broken += not table_row(label, edit, name, options.rounds)
    if options.long:
        broken += not long_row()
    return int(broken > 0)


def long_row() -> bool:
    """Print the row of 60 s, all 216 channels; whether the promise holds."""
    rng = np.random.default_rng(1)
    drives = rng.standard_normal((20, 78_000))
    ratios = []
    for _ in range(3):
        begin = perf_counter()
        total = 0.0
        for place, drive in enumerate(drives, start=1):
            field = fftconvolve(plainly.responses[place], drive[:, None, None], axes=0)
            total = total + field / field.max()
        between = perf_counter()
        response = predict(plainly.limb, drives, range(1, 21), scaling="upstream")
        end = perf_counter()
        ratios.append((between - begin) / (end - between))
    error = np.abs(response - total.transpose(1, 2, 0)).max() / np.abs(total).max()
    ratio = statistics.median(ratios)
    print(
        f"60 s, all 216 channels, 20 inputs of noise, streamed: {1e3 * (between - begin):.0f} and "
        f"{1e3 * (end - between):.0f} ms, ratio {ratio:.1f} (promised 12), difference {error:.0e}"
    )
    return ratio >= 12


def table_row(label: str, edit: Edit, limb: str, rounds: int) -> bool:
    """Print one row; whether the promise holds."""
    inputs = ten_clips_each() if "clips" in label else twenty_inputs()
    start = Design(limb=limb, inputs=inputs, scaling="upstream")
    view = View(axes="xyz", method="mag", outputs=OUTPUTS, selected_inputs=(5,))
    plain = start, view
    if "target" in label:
        alone = add_motion(Design(limb=limb), view, a_target()).design
        start = with_drives(alone, view)
    graph = new_graph()
    graph.evaluate(WANTED, sources(start, view))
    plain_s, studio_s = [], []
    for k in range(rounds + 2):
        steps = [edit(start, view, k * DRAG_STEPS + step) for step in range(DRAG_STEPS)]
        begin = perf_counter()
        plainly(*plain)
        between = perf_counter()
        for design, looked in steps:
            graph.evaluate(WANTED, sources(with_drives(design, looked), looked))
        end = perf_counter()
        plain_s.append(between - begin)
        studio_s.append((end - between) / DRAG_STEPS)
    ratio = statistics.median(a / b for a, b in zip(plain_s[2:], studio_s[2:], strict=True))
    plain_ms, studio_ms = (1e3 * statistics.median(t[2:]) for t in (plain_s, studio_s))
    promised = PROMISED[label]
    mark = "" if ratio >= promised else "  BROKEN"
    print(f"{label:>24} {plain_ms:8.2f} {studio_ms:8.3f} {ratio:7.1f} {promised:9d}{mark}")
    return ratio >= promised


if __name__ == "__main__":
    sys.exit(main())
