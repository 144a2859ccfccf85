"""Quantities of a design for scripts, and their list.

Results for one design are used for the next: each step of a sweep of one input costs as much as an
edit in the studio.
"""

import tomllib
from dataclasses import dataclass, replace
from functools import cache
from threading import Lock
from typing import Any, NamedTuple

from skinsource.base.arguments import checking
from skinsource.base.assets import data_folder
from skinsource.base.errors import InvalidInputError
from skinsource.base.work import Work
from skinsource.design.design import Design, View
from skinsource.engine.graph import Graph, UnknownQuantity
from skinsource.engine.quantities import new_graph, sources
from skinsource.engine.shared import Shared

#: Designs whose results are remembered; each takes some megabytes.
MOST_GRAPHS = 4


@dataclass(slots=True)
class _CachedGraph:
    """A graph, with the design that it computed last, and the input that was edited before."""

    graph: Graph
    design: Design
    edited_input: int | None


class Evaluator:
    """Computes quantities of designs, and remembers the results of the last few designs.

    Threads may call it at the same time; they take turns.

    Attributes
    ----------
    work
        Work done by the latest evaluation.
    """

    def __init__(self) -> None:
        self._lock = Lock()
        self._shared = Shared()
        self._cached: list[_CachedGraph] = []  # the latest last
        self.work = Work()

    def evaluate(
        self, design: Design, quantities: tuple[str, ...], view: View | None = None
    ) -> dict[str, Any]:
        """Return the quantities by name; see `skinsource.evaluate`."""
        with self._lock:
            view = View() if view is None else view
            cached = self._closest(design, view)
            given = {**sources(design, view), "edited_input": cached.edited_input}
            try:
                values = cached.graph.evaluate(quantities, given)
            except UnknownQuantity as error:
                raise InvalidInputError(f"{error.args[0]}. See skinsource.quantities().") from error
            except BaseException:
                # A limb may have been replaced on disk: the next call opens it anew.
                self._cached = [
                    entry for entry in self._cached if not _same_limb(entry.design, design)
                ]
                raise
            self.work = replace(cached.graph.work)
            return values

    def _closest(self, design: Design, view: View) -> _CachedGraph:
        """Return the graph whose design differs from ``design`` in one input, else a new graph."""
        same_limb = [entry for entry in self._cached if _same_limb(entry.design, design)]
        closest = min(
            reversed(same_limb), key=lambda entry: len(_changed(entry.design, design)), default=None
        )
        if closest is not None and len(_changed(closest.design, design)) <= 1:
            self._cached.remove(closest)
        else:
            closest = _CachedGraph(new_graph(self._shared), design, view.selected_input)
        # The changed input is the edited one, as in the studio, so that the sum of the others is
        # computed once.  No number depends on which input is edited.
        changed = _changed(closest.design, design)
        closest.design = design
        closest.edited_input = changed[-1] if changed else closest.edited_input
        self._cached = [*self._cached, closest][-MOST_GRAPHS:]
        return closest


@checking
def evaluate(design: Design, *quantities: str, view: View | None = None) -> dict[str, Any]:
    """Return quantities of a design; any quantity that the studio shows can be requested.

    Nothing else is computed.  Repeated calls are quick where only one input or the view has
    changed since one of the last four designs.  Threads may call it; they take turns.

    Parameters
    ----------
    design
        The stimulus, and the limb.
    quantities
        Names of quantities.  Among them are ``"output_levels_db"`` (72,), dB re 1 m/s²;
        ``"output_rms"`` (72,), m/s²; ``"selected_traces"`` (n_selected, n_times), m/s²;
        ``"selected_spectra"``: frequencies (n_bins,), Hz, and magnitudes (n_selected, n_bins);
        ``"selected_axis_spectra"``, the same along each axis, (n_selected, n_axes, n_bins);
        ``"response_time_s"`` (n_times,), s; ``"input_waveforms"``, an array for each input, also
        for muted ones, from its first clip on, before amplitude, or None for a muted input that
        cannot be sampled; ``"surface_levels_db"`` (rows, columns);
        ``"axis_levels_db"``, for each axis of the limb (72,), dB re 1 m/s².
    view
        Axes, method, span and selected outputs; by default ``View()``.

    Returns
    -------
    dict of str to value.  Arrays are read-only: they are remembered.

    Raises
    ------
    InvalidInputError
        There is no such quantity, or an input cannot be played.
    DatasetMissingError
        The limb is a measured one, and the measured dataset is not installed.

    Examples
    --------
    >>> import skinsource as ss
    >>> tone = ss.track(7, ss.waveforms.Tone(frequency_hz=100.0))
    >>> design = ss.Design(limb="synthetic-1", inputs=(tone,))
    >>> levels = ss.evaluate(design, "output_levels_db")["output_levels_db"]
    >>> levels.shape
    (72,)
    """
    return _evaluator().evaluate(design, quantities, view)


def forget_evaluated() -> None:
    """Drop what `evaluate` remembers."""
    _evaluator.cache_clear()


@cache
def _evaluator() -> Evaluator:
    return Evaluator()


def _same_limb(old: Design, new: Design) -> bool:
    return (old.limb, old.limb_digest) == (new.limb, new.limb_digest)


def _changed(old: Design, new: Design) -> list[int]:
    """Return ids of the inputs that differ; of all inputs where anything else differs."""
    if old.scaling != new.scaling or old.ids != new.ids:
        return [track.id for track in new.inputs]
    return [b.id for a, b in zip(old.inputs, new.inputs, strict=True) if a != b]


class Quantity(NamedTuple):
    """A quantity of `skinsource.evaluate`.

    Attributes
    ----------
    name
        Its name.
    unit
        Unit of its values; empty where they have none.
    shape
        Names of its dimensions: ``n_outputs``, ``n_selected`` (outputs of the view), ``n_axes``,
        ``n_times``, ``n_bins`` (frequencies), ``n_windows``, ``rows`` and ``columns`` (of the map);
        empty for a number.  Spectra are a pair: frequencies, and values of this shape.
    about
        What it is.
    """

    name: str
    unit: str
    shape: tuple[str, ...]
    about: str


def quantities() -> tuple[Quantity, ...]:
    """Return the quantities that `skinsource.evaluate` and `skinsource.result` compute.

    Besides these, which are numbers and arrays, `skinsource.evaluate` knows all values that the
    studio computes.

    Examples
    --------
    >>> import skinsource as ss
    >>> for quantity in ss.quantities()[:3]:
    ...     print(quantity.name, quantity.unit, quantity.shape)
    output_levels_db dB re 1 m/s² ('n_outputs',)
    output_rms m/s² ('n_outputs',)
    record_rms m/s² ('n_outputs',)
    """
    rules = new_graph().rules
    listed = tomllib.loads((data_folder() / "quantities.toml").read_text("utf-8"))
    return tuple(
        Quantity(name, unit, tuple(shape), (rules[name].__doc__ or "").partition("\n")[0])
        for name, (unit, *shape) in listed.items()
    )
