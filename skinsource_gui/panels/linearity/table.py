"""The numbers of the panel for a spreadsheet."""

from skinsource.studies.checking import Proportion, Straightness, Superposition
from skinsource_gui.panels.linearity.strength import StrengthUnit
from skinsource_gui.widgets.copied_numbers import copied

_Lines = list[tuple[str, ...]]


def tab_separated(
    found: Proportion | Superposition,
    outputs: tuple[int, ...],
    axes: tuple[str, ...],
    unit: StrengthUnit,
    *,
    bands: bool = False,
    every: Straightness | None = None,
) -> str:
    """RMS by strength, output by band, how straight each output is, or r of each channel.

    Channels are ``axes`` of each of ``outputs``; ``unit`` is that of strengths; ``bands``: outputs
    are told in bands, all of them; ``every``: how straight all outputs are is told instead.
    """
    channels = [(output, axis) for output in outputs for axis in axes]
    lines: _Lines
    if isinstance(found, Proportion) and every is not None:
        lines = _straight(every, axes)
    elif isinstance(found, Proportion):
        names = [f"{output}_{axis}" for output, axis in channels]
        lines = (_by_band if bands else _by_strength)(found, names, unit)
    else:
        lines = [("output", "axis", "pearson_r")]
        for (output, axis), r in zip(channels, found.correlation, strict=True):
            lines.append((str(output), axis, copied(r)))
    return "".join("\t".join(line) + "\n" for line in lines)


def _straight(every: Straightness, axes: tuple[str, ...]) -> _Lines:
    numbers = range(1, len(every.adjusted_r2) + 1)
    lines: _Lines = [
        ("frequency_hz", *(f"adjusted_r2_{k}_{axis}" for k in numbers for axis in axes))
    ]
    of_channels = every.adjusted_r2.reshape(-1, every.frequency_hz.size)
    for frequency_hz, r2 in zip(every.frequency_hz, of_channels.T, strict=True):
        lines.append((copied(frequency_hz), *map(copied, r2)))
    return lines


def _by_strength(found: Proportion, channels: list[str], unit: StrengthUnit) -> _Lines:
    lines: _Lines = [(unit.column, *(f"rms_{one}_m_per_s2" for one in channels))]
    for strength, rms in zip(found.strengths * unit.si_factor, found.rms, strict=True):
        lines.append((copied(strength), *map(copied, rms)))
    return lines


def _by_band(found: Proportion, channels: list[str], unit: StrengthUnit) -> _Lines:
    told = [f"{unit.column} {strength:.6g}" for strength in found.strengths * unit.si_factor]
    of_strengths = [f"band_rms_{one}_m_per_s2 at {at}" for at in told for one in channels]
    lines: _Lines = [
        ("frequency_hz", *of_strengths, *(f"adjusted_r2_{one}" for one in channels)),
    ]
    for k, frequency_hz in enumerate(found.frequency_hz):
        levels, r2 = found.band_rms[..., k].ravel(), found.adjusted_r2[:, k]
        lines.append((copied(frequency_hz), *map(copied, levels), *map(copied, r2)))
    return lines
