"""What subnormal numbers cost, as a ratio to the same scene with ordinary ones.

Four inputs of 1 s on a made-up limb, by `skinsource.predict` and by the engine (levels of all
outputs and six traces).  Ordinary and subnormal scenes run in turn in one process; medians of the
ratios of the rounds.  Promised: at most 2.

    python benchmarks/denormals.py [--rounds 15]
"""

import argparse
import platform
import statistics
import sys
from collections.abc import Callable
from dataclasses import dataclass
from time import perf_counter

import numpy as np

from skinsource.design.design import Design, View, track
from skinsource.design.waveforms.pulses import Impulse
from skinsource.engine.prediction import predict
from skinsource.engine.quantities import new_graph, sources
from skinsource.limbs.limb import Limb, LimbMap

PROMISED = 2.0
N_TIMES, PLACES = 1300, (3, 7, 12, 18)
OUTPUTS = (29, 30, 33, 35, 38, 52)
TINY = 1e-310


@dataclass(frozen=True, slots=True, eq=False)
class Sampled(Impulse):
    """A waveform that plays given samples."""

    given: np.ndarray

    # Two of them differ, though what an impulse compares is the same.
    __eq__ = object.__eq__
    __hash__ = object.__hash__

    @property
    def duration_s(self) -> float:
        """Length."""
        return self.given.size / 1300

    def samples(self, sample_rate_hz: float, shift_s: float = 0.0) -> np.ndarray:
        """Return what was given."""
        return self.given


def limb_with(tail: float) -> Limb:
    """Responses that decay; the second half is ``tail`` times noise."""

    def respond(place: int) -> np.ndarray:
        random = np.random.default_rng(place)
        response = random.uniform(-1, 1, (72, 3, 522)) * 0.5 ** (np.arange(522) / 40)
        response[..., 261:] = tail * random.uniform(-1, 1, (72, 3, 261))
        return response

    nowhere = LimbMap(
        outline=np.zeros((3, 2)),
        output_positions=np.zeros((72, 2)),
        input_positions=np.zeros((20, 2)),
        hand_length_px=1.0,
    )
    return Limb(
        name="made-up", hand_length_mm=175.0, synthetic=True, map=nowhere, read_response=respond
    )


def drives_with(peak: float, tail: float) -> np.ndarray:
    """Noise whose second half is ``tail`` times noise, all of it times ``peak``."""
    drives = np.random.default_rng(1).uniform(-1, 1, (len(PLACES), N_TIMES))
    drives[:, N_TIMES // 2 :] *= tail
    return drives * peak


def by_predict(limb: Limb, drives: np.ndarray, amplitude: float) -> Callable[[], object]:
    """All 216 channels."""
    return lambda: predict(limb, drives, PLACES, [amplitude] * len(PLACES), scaling="relative")


def by_engine(limb: Limb, drives: np.ndarray, amplitude: float) -> Callable[[], object]:
    """Levels of all outputs and six traces, with nothing remembered."""
    inputs = tuple(
        track(location=place, waveform=Sampled(row), amplitude=amplitude)
        for place, row in zip(PLACES, drives, strict=True)
    )
    design = Design(limb="synthetic-1", inputs=inputs, scaling="relative")
    given = {**sources(design, View(axes="xyz", outputs=OUTPUTS)), "limb_data": limb}
    return lambda: new_graph().evaluate(("output_rms", "axis_traces"), given)


def ratio(ordinary: Callable[[], object], tiny: Callable[[], object], rounds: int) -> float:
    """Median over the rounds of the time of ``tiny`` over that of ``ordinary``."""
    ratios = []
    for _ in range(rounds + 3):
        begin = perf_counter()
        ordinary()
        between = perf_counter()
        tiny()
        ratios.append((perf_counter() - between) / (between - begin))
    return statistics.median(ratios[3:])


def main() -> int:
    """Print the table; 1 if the promise is broken."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--rounds", type=int, default=15)
    rounds = parser.parse_args().rounds
    print(f"{platform.platform()}, Python {platform.python_version()}, numpy {np.__version__}")
    plain, faded = limb_with(1.0), limb_with(TINY)
    scenes = {
        "drives that are all subnormal": (plain, drives_with(TINY, 1.0), 1.0),
        "drives that fade into subnormals": (plain, drives_with(1.0, TINY), 1.0),
        "responses that fade into subnormals": (faded, drives_with(1.0, 1.0), 1.0),
        "subnormal amplitudes": (plain, drives_with(1.0, 1.0), TINY),
    }
    broken = 0
    print(f"{'scene':>36} {'predict':>8} {'engine':>8} {'promised':>9}")
    for label, scene in scenes.items():
        ratios = [
            ratio(way(plain, drives_with(1.0, 1.0), 1.0), way(*scene), rounds)
            for way in (by_predict, by_engine)
        ]
        holds = max(ratios) <= PROMISED
        broken += not holds
        mark = "" if holds else "  BROKEN"
        print(f"{label:>36} {ratios[0]:8.2f} {ratios[1]:8.2f} {PROMISED:9.1f}{mark}")
    return int(broken > 0)


if __name__ == "__main__":
    sys.exit(main())
