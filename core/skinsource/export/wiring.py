"""The wiring page: which channel goes to which place, for the wall beside the setup."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from textwrap import fill
from typing import Any

from skinsource.actuators.actuation import Actuation
from skinsource.actuators.rigs import Rig
from skinsource.base.arguments import checking
from skinsource.base.errors import InvalidInputError, printable
from skinsource.base.files import FilePath, write_bytes
from skinsource.design.design import Design
from skinsource.design.labels import limb_label
from skinsource.engine.stimulus import Channel, in_order, stimulus_of, with_sync
from skinsource.export import plot
from skinsource.export.stimulus_export.options import Nothing, StimulusOptions
from skinsource.export.stimulus_export.preparing import actuator_at, wiring_of
from skinsource.limbs.catalog import limb_of

# A4 upright.
_PAGE_MM = (210.0, 297.0)
_COLUMNS = ("Channel", "Place", "Polarity", "Gain", "Actuator")
_TABLE_MM, _TITLE_LETTERS = 0.84 * _PAGE_MM[0], 72
# Width of a letter, mm in a point of its font.
_LETTER_MM = 0.185


@checking
def export_wiring(
    design: Design,
    path: FilePath,
    *,
    options: StimulusOptions | None = None,
    rig: Rig | Nothing | None = None,
    actuation: Actuation | Nothing | None = None,
) -> None:
    """Write a page that says where each channel of an exported stimulus goes.

    A table has channel, place, polarity, gain and actuator; a hand shows the channels at their
    places.  Needs the extra ``plot``.

    Parameters
    ----------
    design, path
        The design; the file, which ends in ``.pdf``, ``.svg`` or ``.png``.
    options, rig, actuation
        As of `skinsource.export_stimulus`.

    Examples
    --------
    >>> import tempfile
    >>> from pathlib import Path
    >>> import skinsource as ss
    >>> design = ss.Design(limb="synthetic-1", inputs=(ss.track(7), ss.track(12)))
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     ss.export_wiring(design, Path(folder) / "wiring.svg")
    ...     print([path.name for path in Path(folder).iterdir()])
    ['wiring.svg']
    """
    kind = Path(path).suffix.lower()[1:]
    if kind not in plot.METADATA:
        raise InvalidInputError(
            f"{printable(Path(path).name)} is not the name of a page. Call it *.pdf, *.svg or "
            "*.png."
        )
    write_bytes(Path(path), plot.figure_content(wiring_page(design, options, rig, actuation), kind))


def wiring_page(
    design: Design,
    options: StimulusOptions | None = None,
    rig: Rig | Nothing | None = None,
    actuation: Actuation | Nothing | None = None,
) -> Any:
    """Return the figure that `export_wiring` writes."""
    options = options or StimulusOptions()
    per = "input" if options.one_file_per_input else options.per
    # No rate and no equaliser changes the channels.
    drives = stimulus_of(design, per=per, inputs=options.inputs, clips=options.clips)
    if not drives.channels:
        raise InvalidInputError("No input is active: there is no channel to wire. Unmute an input.")
    drives = with_sync(drives) if options.sync else drives
    if options.channel_map:
        drives = in_order(drives, options.channel_map)
    wired, actuators = wiring_of(design, rig, actuation)
    numbers = [f"{channel.number}" for channel in drives.channels]
    if options.one_file_per_input:
        # Each file has the channel of its input, and the sync channel.
        numbers = [
            "2" if channel.place is None else f"1 of input-{channel.inputs[0]}"
            for channel in drives.channels
        ]
    named = list(zip(numbers, drives.channels, strict=True))
    with plot.style():
        figure = new_page(f"Wiring of {design.title}" if design.title else "Wiring")
        _draw_table(figure.add_axes((0.08, 0.04, 0.84, 0.4)), named, wired, actuators)
        _draw_hand(figure.add_axes((0.08, 0.46, 0.84, 0.46)), named, design.limb)
    return figure


def new_page(title: str) -> Any:
    """Return the figure of an upright page that begins with a title."""
    figure = plot.new_figure(*_PAGE_MM)
    title = fill(title, _TITLE_LETTERS)
    figure.text(0.08, 0.98, title, fontsize=12, va="top", parse_math=False)
    return figure


#: Channels with the numbers that they have in their files.
Numbered = Sequence[tuple[str, Channel]]


def _draw_table(ax: Any, channels: Numbered, rig: Rig | None, actuation: Any) -> None:
    rows: list[tuple[str, ...]] = []
    for number, channel in channels:
        place, wired = channel.place, None
        if place is None:
            rows.append((number, channel.title, "", "", ""))
            continue
        wired = None if rig is None else rig.channel_of(place)
        polarity, gain = "normal" if rig is None else "not wired", "not known"
        if wired is not None:
            polarity, gain = wired.polarity, f"{wired.amplifier_gain:g}×"
            number += f" ({wired.device} {wired.output})".replace("( ", "(output ")
            if wired.full_scale_v is not None:
                gain += f", {wired.full_scale_v * wired.amplifier_gain:.4g} V"
        name = actuator_at(place, rig, actuation)[0] or "not known"
        rows.append((number, f"{place}, {channel.title}", polarity, gain, name))
    draw_table(ax, _COLUMNS, rows)


def draw_table(ax: Any, columns: Sequence[str], rows: Sequence[Sequence[str]]) -> None:
    """Fill axes of a page with a table from their top on, in letters as large as fit."""
    ax.set_axis_off()
    # Each column has room for its longest text, with letters to spare beside it.
    letters = [3 + max(map(len, texts)) for texts in zip(columns, *rows, strict=True)]
    size = min(8.0, 160.0 / len(rows), _TABLE_MM / (_LETTER_MM * sum(letters)))
    widths = [count / sum(letters) for count in letters]
    table = ax.table(rows, colLabels=columns, colWidths=widths, cellLoc="left", loc="upper left")
    table.auto_set_font_size(False)
    table.set_fontsize(size)
    for cell in table.get_celld().values():
        cell.PAD = 0.04
        cell.get_text().set_horizontalalignment("left")
        cell.set_edgecolor(plot.DIM)
        cell.set_linewidth(0.4)


def _draw_hand(ax: Any, channels: Numbered, name: str) -> None:
    """Draw the palm side with the number of each channel at its place."""
    limb = limb_of(name)
    outline, places = limb.map.outline, limb.map.input_positions
    low, high = plot.bounds_of(limb, "hand")
    scale = limb.hand_length_mm / limb.map.hand_length_px
    # Seen from the palm, a hand is the mirror image of its back.
    ax.fill(-outline[:, 0] * scale, outline[:, 1] * scale, fc="#f4e9e1", ec=plot.DIM, lw=0.8)
    ax.plot(-places[:, 0] * scale, places[:, 1] * scale, "o", ms=3, mfc="white", mec=plot.DIM)
    at: dict[int, list[str]] = {}
    for number, channel in channels:
        if channel.place is not None:
            at.setdefault(channel.place, []).append(number)
    for place, numbers in at.items():
        x, y = places[place - 1] * scale
        text = ", ".join(numbers)
        box = {"boxstyle": "round,pad=0.3", "fc": plot.COLOURS[0], "ec": "white"}
        ax.text(-x, y, text, ha="center", va="center", color="white", fontsize=8, bbox=box)
    ax.set_xlim(-high[0] - 8.0, -low[0] + 8.0)
    ax.set_ylim(low[1], high[1] + 8.0)
    ax.set_aspect("equal")
    ax.set_axis_off()
    ax.set_title(f"{limb_label(name).title}, palm side: channels at their places")
