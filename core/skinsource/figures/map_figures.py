"""Figures that are maps beside each other."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from skinsource.arrays import Floats
from skinsource.decibels import in_tables
from skinsource.figures.sheet import WIDTH_MM, Drawn, Sheet, Table
from skinsource.figures.values import axes_of_sensors, loudest_of
from skinsource.map_range import MAP_RANGE_DB
from skinsource.plot.levels import Levels, Range, common_range, levels_of
from skinsource.plot.maps import HATCHED, Bar, draw_map
from skinsource.plot.paper import style
from skinsource.scenes import OpenedScene

_HEIGHT_MM, _BAR_ROOM_MM = 92.0, 20.0
_UNIT = "dB re 1 m/s²"
_RELATIVE = (-MAP_RANGE_DB, 0.0)


def maps_in_one_scale(opened: OpenedScene) -> Drawn:
    """A map for each design, all in one scale of levels."""
    levels = [levels_of(one.design, None, opened.view) for one in opened.conditions]
    colours = common_range(*(one.values for one in levels))
    return maps_figure(opened, levels, _labels(opened), colours, _UNIT)


def maps_each_relative(opened: OpenedScene) -> Drawn:
    """A map for each design, each re its loudest output."""
    levels = [levels_of(one.design, None, opened.view) for one in opened.conditions]
    words, tops = "dB re the loudest output of each", loudest_of(levels, together=False)
    return maps_figure(opened, levels, _labels(opened), _RELATIVE, words, tops)


def maps_of_axes(opened: OpenedScene) -> Drawn:
    """A map for each axis, all re the loudest output on any axis."""
    single = axes_of_sensors(opened.design)
    levels = [levels_of(opened.design, None, replace(opened.view, axes=axis)) for axis in single]
    titles = [f"Along {axis}" for axis in single]
    words, tops = "dB re the loudest output on any axis", loudest_of(levels, together=True)
    return maps_figure(opened, levels, titles, _RELATIVE, words, tops)


def maps_figure(
    opened: OpenedScene,
    levels: Sequence[Levels],
    titles: Sequence[str],
    colours: Range,
    words: str,
    tops_db: Sequence[float] = (),
) -> Drawn:
    """Maps beside each other with one colour bar, and the level of each output as a table.

    ``tops_db``: what the levels of each map are told re; 0 dB unless given.
    """
    tops_db = tops_db or [0.0] * len(levels)
    noisy = any(one.noisy for one in levels)
    sheet = Sheet(opened, _HEIGHT_MM, f"{HATCHED}." if noisy else "", maps=True)
    room_mm = min(WIDTH_MM - _BAR_ROOM_MM - 6.0, 50.0 * len(levels))
    left_mm = (WIDTH_MM - _BAR_ROOM_MM - room_mm) / 2.0
    with style():
        places = sheet.row_of_axes(len(levels), left_mm, 2.0, room_mm, _HEIGHT_MM - 8.0)
        image = None
        for k, (ax, one, title) in enumerate(zip(places, levels, titles, strict=True)):
            bar: Bar = "drawn" if k == len(levels) - 1 else "room"
            shown = replace(one, values=one.values - tops_db[k])
            image = draw_map(ax, shown, colours, title=title, bar=bar)
        sheet.colour_bar(image, left_mm + room_mm + 2.0, 24.0, 50.0, words)
    values = [in_tables(one.values) - top for one, top in zip(levels, tops_db, strict=True)]
    return Drawn(sheet=sheet, tables={"": levels_table(titles, values, words)})


def levels_table(titles: Sequence[str], values: Sequence[Floats], words: str) -> Table:
    """A row for each output."""
    header = ["output", *(f"{title.replace(',', '')} ({words})" for title in titles)]
    numbers = np.arange(1.0, values[0].size + 1.0)
    return Table(header=header, rows=np.column_stack((numbers, *values)))


def _labels(opened: OpenedScene) -> list[str]:
    return [one.label for one in opened.conditions]
