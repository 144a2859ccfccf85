"""Levels above threshold as a table."""

from skinsource.engine.analysis_rules import SILENT_DB, Sensation
from skinsource.limbs.locations import output_words
from skinsource_gui.widgets.copied_numbers import copied_level

_TITLES = {"P": "P\ndB", "NP I": "NP I\ndB", "own": "Own\ndB"}
_HINTS = {
    "P": "Above the threshold of the Pacinian channel, which governs fast vibrations",
    "NP I": "Above the threshold of the channel NP I, which governs slow ones and the arm",
    "own": "Above the thresholds of your own table",
}


def header(found: Sensation) -> list[tuple[str, str]]:
    """Titles and hints of the columns."""
    columns = [("Output", "Number and place"), ("Above\ndB", "Above the lowest threshold")]
    columns += [(_TITLES[name], _HINTS[name]) for name in found.by_channel]
    if found.strength is not None:
        said = "Larger channel and half of the smaller one; only compares, on one limb"
        columns.append(("Strength", said))
    return columns


def rows(found: Sensation, outputs: tuple[int, ...], limb: str = "") -> list[list[str]]:
    """Texts of the rows, for outputs of a limb."""
    return [
        [
            f"{output}  {output_words(output, limb).short_name}",
            *map(_text, _numbers(found, output)),
        ]
        for output in outputs
    ]


def tab_separated(found: Sensation, outputs: tuple[int, ...], limb: str = "") -> str:
    """The table for a spreadsheet; empty where a dash is shown."""
    names = ["output", "place", "above_threshold_db"]
    names += [f"{name.replace(' ', '_').lower()}_db" for name in found.by_channel]
    names += ["strength"] if found.strength is not None else []
    lines = ["\t".join(names)]
    for output in outputs:
        numbers = (copied_level(one) for one in _numbers(found, output))
        lines.append("\t".join((str(output), output_words(output, limb).short_name, *numbers)))
    return "\n".join(lines) + "\n"


def _numbers(found: Sensation, output: int) -> list[float]:
    k = output - 1
    numbers = [float(found.level_db[k]), *(float(one[k]) for one in found.by_channel.values())]
    if found.strength is None:
        return numbers
    # What is not felt at all has no strength either.
    felt = found.level_db[k] > SILENT_DB
    return [*numbers, float(found.strength[k]) if felt else SILENT_DB]


def _text(value: float) -> str:
    return "–" if value <= SILENT_DB else f"{value:z.1f}".replace("-", "−")
