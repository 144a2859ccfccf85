"""The numbers of the panel for a spreadsheet."""

from skinsource.checking import Proportion, Superposition
from skinsource_gui.widgets.copied_numbers import copied


def tab_separated(
    found: Proportion | Superposition, outputs: tuple[int, ...], axes: tuple[str, ...]
) -> str:
    """RMS by strength, or r of each channel; channels are ``axes`` of each of ``outputs``."""
    channels = [(output, axis) for output in outputs for axis in axes]
    lines: list[tuple[str, ...]]
    if isinstance(found, Proportion):
        lines = [("strength", *(f"rms_{output}_{axis}_m_per_s2" for output, axis in channels))]
        for strength, rms in zip(found.strengths, found.rms, strict=True):
            lines.append((copied(strength), *map(copied, rms)))
    else:
        lines = [("output", "axis", "pearson_r")]
        for (output, axis), r in zip(channels, found.correlation, strict=True):
            lines.append((str(output), axis, copied(r)))
    return "".join("\t".join(line) + "\n" for line in lines)
