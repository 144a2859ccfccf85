"""``skinsource check``: linearity, superposition, and agreement with recorded responses."""

import argparse
import sys
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from skinsource.analysis.statistics import dominant_frequency
from skinsource.arrays import Floats
from skinsource.comparing.snapshot import louder
from skinsource.design import Design, audible_inputs
from skinsource.design_file import open_design
from skinsource.errors import InvalidInputError
from skinsource.export.output_file import output_file
from skinsource.job import never
from skinsource.quantities import new_graph, sources
from skinsource.validation import (
    agreement,
    aligned,
    linear_fit,
    open_recorded,
    superposition_correlation,
)
from skinsource.validation.report import Condition, report_html, summary_lines
from skinsource.version import __version__
from skinsource.view import View

_LEVELS = (0.25, 0.5, 1.0, 2.0)
# A recording may start this much earlier or later than the prediction.
_MOST_SHIFT_S = 0.2
# Longer ones would take gigabytes: all channels are held, at several levels.
_LONGEST_SAMPLES = 20_000


def add_to(subparsers: Any) -> None:
    """Add the command ``check``."""
    parser = subparsers.add_parser(
        "check",
        help="check linearity and superposition, and agreement with recorded responses",
        description="For each design: whether outputs are in proportion to inputs, whether inputs "
        "add up, and, with --measured, the figures of the paper's Fig. 4 against recorded "
        "responses (CSV, NPZ, MATLAB, HDF5: times by outputs and axes).",
    )
    parser.add_argument("designs", type=Path, nargs="+", metavar="DESIGN", help=".skinsource files")
    parser.add_argument(
        "--measured",
        type=Path,
        nargs="+",
        default=[],
        metavar="FILE",
        help="recorded responses, one file for each design, in their order",
    )
    parser.add_argument(
        "--axes", default="xyz", choices=("x", "y", "z", "xyz"), help="axes that were recorded"
    )
    parser.add_argument("--out", type=Path, metavar="FILE", help="an HTML report to write")
    parser.set_defaults(run=_check)


def _check(arguments: argparse.Namespace) -> int:
    measured = arguments.measured or [None] * len(arguments.designs)
    if len(measured) != len(arguments.designs):
        raise InvalidInputError(
            f"{len(measured)} recordings for {len(arguments.designs)} designs, expected one for "
            "each. Name them in the same order."
        )
    conditions = [
        _condition(design, recording, arguments.axes)
        for design, recording in zip(arguments.designs, measured, strict=True)
    ]
    sys.stdout.write("\n".join(summary_lines(conditions)) + "\n")
    if arguments.out is not None:
        limbs = sorted({open_design(path).design.limb for path in arguments.designs})
        about = (f"skinsource {__version__}; limb: {', '.join(limbs)}",)
        with output_file(arguments.out, never) as file:
            file.write(report_html(conditions, about).encode())
        sys.stdout.write(f"{arguments.out}\n")
    return 0


def _condition(path: Path, recording: Path | None, axes: Any) -> Condition:
    design = open_design(path).design
    seen = View(axes=axes)
    # What is compared is the prediction through the graph of the studio, not one made for it.
    basis = _values(design, seen, "limb_data", "response_samples", "noise_energy")
    limb, n_times = basis["limb_data"], basis["response_samples"]
    if n_times > _LONGEST_SAMPLES:
        raise InvalidInputError(
            f"{path.name} is {n_times / limb.sample_rate_hz:.1f} s long, expected at most "
            f"{_LONGEST_SAMPLES / limb.sample_rate_hz:.1f} s: all channels are compared"
        )
    every = replace(seen, outputs=tuple(range(1, limb.n_outputs + 1)))
    field = _values(design, every, "axis_traces")["axis_traces"]
    linear, superposed = _checks(design, every, field, limb.sample_rate_hz)
    found = Condition(
        name=path.name,
        frequency_hz=_main_frequency(field, limb.sample_rate_hz),
        linear=linear,
        superposed=superposed,
    )
    if recording is None:
        return found
    taken = open_recorded(recording, limb.n_outputs, field.shape[1], limb.sample_rate_hz)
    shifted, shift = aligned(taken, field, round(_MOST_SHIFT_S * limb.sample_rate_hz))
    numbers = [limb.axes.index(axis) for axis in (limb.axes if axes == "xyz" else axes)]
    energy = basis["noise_energy"]
    noise = 0.0 if energy is None else np.sqrt(energy[:, numbers] / n_times)
    return replace(found, agreement=agreement(field, shifted, noise), shift_samples=shift)


def _checks(design: Design, view: View, field: Floats, rate: float) -> tuple[float, float]:
    """Smallest adjusted R² over levels, and smallest r between the sum of inputs and all."""
    if not field.any():
        return float("nan"), float("nan")
    at_levels = [_values(louder(design, k), view, "axis_traces")["axis_traces"] for k in _LEVELS]
    channels = np.stack(at_levels).reshape(len(_LEVELS), -1, field.shape[-1])
    fit = linear_fit(_LEVELS, channels, rate)[1]
    heard = audible_inputs(design.inputs)
    if len(heard) < 2:
        return float(np.nanmin(fit)), float("nan")
    parts = []
    for one in heard:
        alone = tuple(replace(each, muted=each.id != one.id, solo=False) for each in design.inputs)
        trace = _values(replace(design, inputs=alone), view, "axis_traces")["axis_traces"]
        whole = np.zeros(field.shape)
        whole[..., : trace.shape[-1]] = trace[..., : field.shape[-1]]
        parts.append(whole.reshape(-1, field.shape[-1]))
    r = superposition_correlation(np.stack(parts), field.reshape(-1, field.shape[-1]))
    return float(np.nanmin(fit)), float(np.nanmin(r))


def _main_frequency(field: Floats, rate: float) -> float:
    """Frequency with the most power over all channels; NaN for silence."""
    power = np.sum(np.square(np.abs(np.fft.rfft(field, axis=-1))), axis=(0, 1))
    return float(dominant_frequency(power, rate / field.shape[-1]))


def _values(design: Design, view: View, *names: str) -> dict[str, Any]:
    return new_graph().evaluate(names, sources(design, view))
