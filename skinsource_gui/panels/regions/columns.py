"""Columns of the table of regions."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import partial

import numpy as np

from skinsource.base.decibels import FLOOR_DB
from skinsource.design.comparing import REGION_OUTPUTS, mean_and_spread, region_levels_db
from skinsource.design.labels import LIMBS, word_of
from skinsource.limbs.limb import PUBLISHED
from skinsource_gui.compared import LEVELS_MATCHED, Compared, gain_db
from skinsource_gui.figure_panel import COMPUTING
from skinsource_gui.widgets.copied_numbers import copied_level
from skinsource_gui.widgets.fields.level_text import minus

#: What is said of own limbs.
NO_REGIONS = "Of an own limb it is not known which outputs lie in which region"


@dataclass(frozen=True, slots=True, kw_only=True)
class Column:
    """A column: its title, what it is, and a text and a number for each region.

    ``head`` is the title in two narrow lines, where it is not as narrow itself; ``spelt`` what the
    table for a spreadsheet has in its place; ``computing``: there are no numbers yet.
    """

    title: str
    hint: str
    numbers: tuple[float, ...]
    head: str = ""
    synthetic: bool = False
    computing: bool = False
    spelt: str = ""

    @property
    def has_levels(self) -> bool:
        """Whether there is any number: there is none of a limb that is missing, or of silence."""
        return any(np.isfinite(one) and one > FLOOR_DB for one in self.numbers)

    def texts(self) -> list[str]:
        """As they are shown: a dash where there is no number, as for silence; dots until it is."""
        if self.computing:
            return ["…"] * len(self.numbers)
        return [
            "–" if not np.isfinite(one) or one <= FLOOR_DB else f"{one:z.1f}".replace("-", "−")
            for one in self.numbers
        ]


def columns_of(snapshots: Sequence[Compared], *, matched: bool) -> list[Column]:
    """Snapshots, where any is stored; ``matched``: they are shown as loud as each other."""
    if len(snapshots) < 2:
        return []
    found = [_column(*_stored(one), one) for one in snapshots]
    if not matched:
        return found
    said = [f", {LEVELS_MATCHED} ({minus(f'{gain_db(one):+z.1f}')} dB)" for one in snapshots]
    return [
        replace(column, hint=f"{column.hint}{words}") if column.has_levels else column
        for column, words in zip(found, said, strict=True)
    ]


def columns_of_people(people: Sequence[Compared]) -> list[Column]:
    """People, their mean, and their standard deviation."""
    of_people = [_column(*_names(one), one) for one in people]
    found = list(of_people)
    known = [one.numbers for one in of_people if np.isfinite(one.numbers).all()]
    # A mean of those that happen to be known already would change by itself.
    computing = any(one.values is None and not one.problem for one in people)
    if len(known) > 1 and not computing:
        by_region = np.array(known).T
        pairs = [mean_and_spread(levels) for levels in by_region]
        # Silence is no level that others could lie about.
        felt = [bool(np.all(levels > FLOOR_DB)) for levels in by_region]
        what = f"over {len(known)} people, dB"
        found.append(
            Column(
                title="Mean",
                hint=f"Mean {what} re 1 m/s²",
                numbers=tuple(mean for mean, _ in pairs),
                spelt=f"Mean over {len(known)} people",
            )
        )
        found.append(
            Column(
                title="± dB",
                head="±\ndB",
                hint=f"Standard deviation {what}",
                spelt=f"Standard deviation {what}",
                numbers=tuple(
                    spread if heard else float("nan")
                    for (_, spread), heard in zip(pairs, felt, strict=True)
                ),
            )
        )
    return found


def _limb(one: Compared) -> str:
    return one.snapshot.design.limb


def _names(one: Compared) -> tuple[str, str]:
    """Title and head of a limb; one that is computed is called so."""
    number = _limb(one).rpartition("-")[2]
    if _is_synthetic(one):
        return f"Synthetic {number}", f"Syn.\n{number}"
    return f"Limb {number}", f"Limb\n{number}"


def _stored(one: Compared) -> tuple[str, str]:
    """Title and head of a snapshot."""
    return (f"{one.name}, synthetic", f"{one.name}\nsyn.") if _is_synthetic(one) else (one.name, "")


def _is_synthetic(one: Compared) -> bool:
    return _limb(one).startswith("synthetic-")


def _column(title: str, head: str, one: Compared) -> Column:
    kind = "synthetic" if _is_synthetic(one) else "measured"
    spelt = title if kind in title.lower() else f"{title}, {kind}"
    if _limb(one) not in PUBLISHED:
        spelt = title
    said = partial(Column, title=title, head=head, synthetic=_is_synthetic(one), spelt=spelt)
    nothing = (float("nan"),) * len(REGION_OUTPUTS)
    if one.values is None:
        computing = not one.problem
        return said(hint=one.problem or COMPUTING, numbers=nothing, computing=computing)
    if _limb(one) not in PUBLISHED:
        return said(hint=NO_REGIONS, numbers=nothing)
    rms = 10.0 ** (one.values["output_levels_db"] / 20.0)
    levels = region_levels_db(rms * one.gain)
    limb = word_of(LIMBS, _limb(one)).title
    return said(hint=f"{title}: dB re 1 m/s², {limb}", numbers=tuple(levels.values()))


def tab_separated(columns: Sequence[Column]) -> str:
    """The table for a spreadsheet; empty where a dash is shown."""
    lines = [
        "\t".join(
            (
                "region_db_re_1_m_per_s2",
                *(one.spelt or one.title for one in columns),
            )
        )
    ]
    for row, region in enumerate(REGION_OUTPUTS):
        lines.append("\t".join((region, *(copied_level(one.numbers[row]) for one in columns))))
    return "\n".join(lines) + "\n"
