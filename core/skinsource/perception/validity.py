"""Validity: conditions of the measurement (SkinSource, 2024), and whether a design keeps them.

Findings go with every result, as captions and as lines of files.
"""

import re
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, replace
from operator import mul
from typing import Literal

import numpy as np

from skinsource.base.conventions import BAND_HZ, LARGEST_VELOCITY_M_PER_S, Band, Floats
from skinsource.base.errors import sentence
from skinsource.limbs.limb import Limb
from skinsource.limbs.scaling import Scaling
from skinsource.signals.analysis.intervals import integrated
from skinsource.signals.analysis.noise import LEAST_ABOVE_NOISE_DB
from skinsource.signals.spectra import share_outside_band

#: ``"kept"``, ``"left"``, or ``"unknown"`` where it is not known.
State = Literal["kept", "left", "unknown"]


@dataclass(frozen=True, slots=True, kw_only=True)
class Finding:
    """A condition of the measurement.

    Attributes
    ----------
    name
        ``"band"``, ``"drive"``, ``"spacing"``, ``"noise"``, ``"limb"`` or ``"scaling"``; or
        ``"inputs"``, where some are left out because they cannot be played.
    state
        Whether the design keeps it.
    sentence
        What was found, and what it means.
    in_short
        The same where there is little room, as below a picture; "" where it is not left.  In place
        of its number stands a field such as ``"{:.0%}"``: of several designs it is a range.
    number
        That number; None where there is none.
    repair
        Name of the edit that repairs it: ``"quieter"``, ``"band_limit"``,
        ``"probe_scaling"``, ``"deselect"``; "" where nothing does.
    factor
        Factor of the amplitudes that repairs it; else 1.
    outputs
        Those that it is about; none: it is about all.
    of_maps
        Whether it is about what maps draw between outputs, and about nothing else.
    """

    name: str
    state: State
    sentence: str
    in_short: str = ""
    number: float | None = None
    repair: str = ""
    factor: float = 1.0
    outputs: tuple[int, ...] = ()
    of_maps: bool = False


Findings = tuple[Finding, ...]


def findings_lines(findings: Findings) -> list[str]:
    """Return a line for each condition that is not kept, for the head of a file."""
    state_labels = {"left": "CAUTION", "unknown": "unknown"}
    return [
        f"validity, {finding.name}: {state_labels[finding.state]}: {finding.sentence}"
        for finding in findings
        if finding.state in state_labels
    ]


_FIELD = re.compile(r"(\{:[^}]*\})")
_NOT_JUDGED = "conditions of the measurement were not checked"


@dataclass(frozen=True, slots=True, kw_only=True)
class Judged:
    """A design that a result shows, with its notes and findings.

    Attributes
    ----------
    label
        What it is called there, such as the title of its limb.
    note
        What there is to note of its limb; "" where there is nothing.
    findings
        Conditions of the measurement; None: they were not judged.
    """

    label: str
    note: str = ""
    findings: Findings | None = None

    def without_maps(self) -> "Judged":
        """Return the same without findings about maps, for what draws none."""
        if self.findings is None:
            return self
        return replace(
            self, findings=tuple(finding for finding in self.findings if not finding.of_maps)
        )


def in_short(judged: Sequence[Judged]) -> tuple[str, ...]:
    """Return notes and conditions that are not kept, a short sentence each, for a caption.

    Where numbers differ between designs, the smallest and the largest stand.
    """
    numbers: dict[str, list[float]] = {}
    for design in judged:
        for finding in design.findings or ():
            if finding.number is not None:
                numbers.setdefault(finding.in_short, []).append(finding.number)
    captions = _merged(judged, _captions_of)
    return tuple(
        sentence(prefix + (_with_range(text, numbers[text]) if text in numbers else text))
        for prefix, text in captions
    )


def in_full(judged: Sequence[Judged]) -> tuple[str, ...]:
    """Return the same as lines for the head of a table, with unknown conditions too."""
    return tuple(f"{prefix}{text}" for prefix, text in _merged(judged, _lines_of))


def _merged(
    judged: Sequence[Judged], texts_of: Callable[[Judged], Sequence[str]]
) -> list[tuple[str, str]]:
    """Return each text once, with the labels of the designs that it holds for if not for all."""
    labels_of: dict[str, list[str]] = {}
    for design in judged:
        for text in dict.fromkeys(texts_of(design)):
            labels_of.setdefault(text, []).append(design.label)
    return [
        ("" if len(labels) == len(judged) else f"{', '.join(labels)}: ", text)
        for text, labels in labels_of.items()
    ]


def _with_range(text: str, numbers: Sequence[float]) -> str:
    """Return the text with its number, or with two where numbers look different."""
    before, field, after = _FIELD.split(text, maxsplit=1)
    ends = dict.fromkeys(field.format(number) for number in (min(numbers), max(numbers)))
    return f"{before}{' to '.join(ends)}{after}"


def _captions_of(design: Judged) -> list[str]:
    note = [f"{design.note[:1].upper()}{design.note[1:]}"] if design.note else []
    if design.findings is None:
        return [*note, f"{_NOT_JUDGED[:1].upper()}{_NOT_JUDGED[1:]}"]
    return [*note, *(finding.in_short for finding in design.findings if finding.in_short)]


def _lines_of(design: Judged) -> list[str]:
    note = [f"NOTE on the limb: {design.note}"] if design.note else []
    return note + (
        [f"validity: {_NOT_JUDGED}"] if design.findings is None else findings_lines(design.findings)
    )


# Lowest frequency of a velocity: from a lower one on it would need minutes of silence.
_LEAST_HZ = 1.0


def are_probe_accelerations(limb: Limb, scaling: Scaling, *, actuated: bool) -> bool:
    """Whether drives are accelerations of a probe, m/s².

    Not where actuators move in its place, nor where a lab's own responses answer a drive: nobody
    says in which unit that was.
    """
    return scaling == "probe" and not actuated and not limb.per_unit_drive


def probe_velocity(
    acceleration: Floats, sample_rate_hz: float, lowest_hz: float = BAND_HZ[0]
) -> float:
    """Return the largest velocity of a probe, m/s, from its acceleration.

    By division of the spectrum; what is slower than the measured band is faded out over the octave
    below it (a raised cosine, from 12.5 to 25 Hz of the published limbs), because it would drift.

    Parameters
    ----------
    acceleration : (n_times,)
        m/s², silent before and after.
    sample_rate_hz
        Its rate.
    lowest_hz
        Where the measured band begins.
    """
    if not acceleration.any():
        return 0.0
    return float(np.abs(integrated(acceleration, sample_rate_hz, lowest_hz)).max())


def fastest_probe(
    drives: Iterable[Floats], sample_rate_hz: float, band_hz: Band | None = BAND_HZ
) -> float:
    """Return the largest velocity of any of the probes that are driven so, m/s; 0: none is."""
    lowest_hz = lowest_hz_of(band_hz)
    return max((probe_velocity(drive, sample_rate_hz, lowest_hz) for drive in drives), default=0.0)


def lowest_hz_of(band_hz: Band | None) -> float:
    """Return the frequency below which no velocity is computed, in Hz."""
    low_hz = 0.0 if band_hz is None else band_hz[0]
    return max(low_hz, _LEAST_HZ) if low_hz > 0.0 else BAND_HZ[0]


#: Above it wavelengths are too short for the spacing of the published limbs' outputs.
SPATIAL_LIMIT_HZ = 300.0
#: Largest share of the energy that may lie outside of a band.
MOST_SHARE = 0.05
_MM_PER_M = 1e3
_LIMIT = f"{LARGEST_VELOCITY_M_PER_S * _MM_PER_M:g} mm/s"
_MAP_GUESSED = "lies above {:g} Hz: between outputs the map is a guess."
_UNIT_NOT_KNOWN = Finding(
    name="drive",
    state="unknown",
    sentence=(
        "The drive of this limb has an unknown unit, so the probe velocity is unknown; the skin "
        f"responds linearly up to {_LIMIT}."
    ),
)


def drive_findings(
    drives: Sequence[tuple[int, Floats]],
    sample_rate_hz: float,
    scaling: Scaling,
    *,
    probe: bool = True,
    unit_known: bool = True,
    band_hz: Band | None = BAND_HZ,
    spatial_limit_hz: float | None = SPATIAL_LIMIT_HZ,
) -> Findings:
    """Return what is found in what is played: band, drive, and spacing.

    Parameters
    ----------
    drives
        Input place and samples, (n_times,); in probe scaling m/s².
    sample_rate_hz
        Their rate.
    scaling
        What their unit is.
    probe
        Whether they are what the probe does, not what an actuator shall do.
    unit_known
        Whether responses answer an acceleration, not a drive of whatever unit.
    band_hz
        In which the responses were measured; None: it is not known.
    spatial_limit_hz
        Up to which the outputs stand close enough; None: it is not known.
    """
    played = [samples for _, samples in drives]
    return (
        _band(played, sample_rate_hz, band_hz),
        _velocity(played, sample_rate_hz, scaling, band_hz, probe=probe)
        if unit_known
        else _UNIT_NOT_KNOWN,
        _spacing(played, sample_rate_hz, spatial_limit_hz),
    )


def noise_findings(above_noise_db: Floats | None, *, synthetic: bool, silent: bool) -> Finding:
    """Return what is found of the noise in the outputs.

    Parameters
    ----------
    above_noise_db : (n_outputs,) or None
        Level above that of the noise; None: nothing is known of it.
    synthetic, silent
        Why nothing may be known.
    """
    if silent:
        return Finding(name="noise", state="kept", sentence="No input is active.")
    if above_noise_db is None:
        if synthetic:
            sentence = "A synthetic limb has no noise; the sensors of a measurement have."
        else:
            sentence = "The noise is unknown: the responses hold too little before the pulse."
        return Finding(name="noise", state="unknown", sentence=sentence)
    noisy = tuple(int(k) + 1 for k in np.flatnonzero(above_noise_db < LEAST_ABOVE_NOISE_DB))
    least = f"{LEAST_ABOVE_NOISE_DB:g} dB"
    if not noisy:
        sentence = f"All outputs are {least} or more above the noise of their sensors."
        return Finding(name="noise", state="kept", sentence=sentence)
    few = f"{above_noise_db.size} outputs are less than {least} above the noise"
    return Finding(
        name="noise",
        state="left",
        in_short=f"{{:.0f}} of {few}.",
        number=len(noisy),
        sentence=(
            f"{len(noisy)} of {few} of the measurement: {number_ranges(noisy)}. Their levels are "
            "mostly noise over the whole record; the skin map hatches them."
        ),
        repair="deselect",
        outputs=noisy,
    )


def noisy_outputs(findings: Findings) -> tuple[int, ...]:
    """Return the numbers of the outputs that are mostly noise: maps hatch them."""
    return next((found.outputs for found in findings if found.name == "noise"), ())


def setup_findings(
    *, synthetic: bool, scaling: Scaling, places: Sequence[int], note: str = ""
) -> Findings:
    """Return what is found in the choice of limb and scaling.

    Parameters
    ----------
    synthetic
        Whether the limb is computed.
    scaling
        What an amplitude of 1 means.
    places
        Input places that play.
    note
        What is known of the files of the limb.
    """
    measured = ", ".join(filter(None, ("Responses of this limb were measured", note)))
    limb = Finding(name="limb", state="kept", sentence=f"{measured}.")
    if synthetic:
        limb = Finding(
            name="limb",
            state="left",
            in_short="Responses are computed from a model, not measured.",
            sentence="Responses of this limb are computed from a model of waves, not measured.",
        )
    if scaling != "upstream" or not places:
        sentence = "Levels at different places are comparable."
        return limb, Finding(name="scaling", state="kept", sentence=sentence)
    hidden = Finding(
        name="scaling",
        state="left",
        in_short="This scaling hides that some places carry less than others.",
        sentence="This scaling gives each input the same peak on the skin, which hides differences "
        "between places.",
        repair="probe_scaling",
    )
    return limb, hidden


def number_ranges(outputs: Sequence[int]) -> str:
    """Return numbers as text, runs of three or more as ranges: "1, 4 to 7 and 9".

    >>> number_ranges((1, 4, 5, 6, 7, 9, 10))
    '1, 4 to 7, 9 and 10'
    """
    runs: list[list[int]] = []
    for number in sorted(outputs):
        if runs and number == runs[-1][-1] + 1:
            runs[-1].append(number)
        else:
            runs.append([number])
    parts: list[str] = []
    for run in runs:
        parts += [f"{run[0]} to {run[-1]}"] if len(run) > 2 else [str(number) for number in run]
    return parts[0] if len(parts) == 1 else f"{', '.join(parts[:-1])} and {parts[-1]}"


def _share(played: Sequence[Floats], rate: float, band: Band) -> float:
    """Return the share of the energy of all drives outside a band; 0 in silence."""
    energies = [float(np.vdot(drive, drive)) for drive in played]
    if sum(energies) == 0.0:
        return 0.0
    shares = [share_outside_band(drive, rate, band) for drive in played]
    return sum(map(mul, shares, energies)) / sum(energies)


def _band(played: Sequence[Floats], rate: float, band_hz: Band | None) -> Finding:
    if band_hz is None:
        sentence = (
            "The measured band of this limb is unknown, so the stimulus cannot be compared with it."
        )
        return Finding(name="band", state="unknown", sentence=sentence)
    share = _share(played, rate, band_hz)
    band = f"{band_hz[0]:g} to {band_hz[1]:g} Hz"
    lies = f"{share:.0%} of the stimulus energy lies outside the measured {band}"
    if share <= MOST_SHARE:
        return Finding(name="band", state="kept", sentence=f"{lies}.")
    return Finding(
        name="band",
        state="left",
        in_short=f"{{:.0%}} of the energy lies outside the measured {band}.",
        number=share,
        sentence=f"{lies}; the response of the skin there is unknown.",
        repair="band_limit",
    )


def _velocity(
    played: Sequence[Floats], rate: float, scaling: Scaling, band_hz: Band | None, *, probe: bool
) -> Finding:
    if scaling != "probe":
        return Finding(
            name="drive",
            state="unknown",
            sentence=(
                "The probe velocity is unknown in this scaling; the skin responds linearly up to "
                f"{_LIMIT}."
            ),
            repair="probe_scaling",
        )
    if not probe:
        sentence = "The probe velocity depends on the actuator; see the Output panel."
        return Finding(name="drive", state="unknown", sentence=sentence)
    fastest = fastest_probe(played, rate, band_hz)
    lowest_hz = lowest_hz_of(band_hz)
    moves, speed = "Peak probe velocity {:.3g} mm/s", fastest * _MM_PER_M
    moved = f"{moves.format(speed)}, from {lowest_hz:g} Hz on"
    if fastest <= LARGEST_VELOCITY_M_PER_S:
        sentence = f"{moved}; up to {_LIMIT} the skin responds linearly."
        return Finding(name="drive", state="kept", sentence=sentence)
    beyond = f"above {_LIMIT} the skin no longer responds linearly."
    return Finding(
        name="drive",
        state="left",
        in_short=f"{moves}; {beyond}",
        number=speed,
        sentence=f"{moved}; {beyond}",
        repair="quieter",
        factor=LARGEST_VELOCITY_M_PER_S / fastest,
    )


def _spacing(played: Sequence[Floats], rate: float, limit_hz: float | None) -> Finding:
    if limit_hz is None:
        sentence = (
            "The highest frequency that the outputs of this limb resolve is unknown: between them "
            "the map may be a guess."
        )
        return Finding(name="spacing", state="unknown", sentence=sentence, of_maps=True)
    share = _share(played, rate, (0.0, limit_hz))
    lies = f"{share:.0%} of the stimulus energy lies above {limit_hz:g} Hz"
    if share <= MOST_SHARE:
        sentence = f"{lies}; the outputs are dense enough up to there."
        return Finding(name="spacing", state="kept", sentence=sentence, of_maps=True)
    return Finding(
        name="spacing",
        of_maps=True,
        state="left",
        in_short=f"{{:.0%}} of the energy {_MAP_GUESSED.format(limit_hz)}",
        number=share,
        sentence=f"{lies}, where waves are too short for the spacing of the outputs: between them "
        "the map is a guess.",
    )
