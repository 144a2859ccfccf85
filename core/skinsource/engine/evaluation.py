"""The quantities of a design, for scripts: the graph without the window.

What was computed for one design is used for the next: a sweep of one input costs at each step what
an edit costs in the studio.
"""

from dataclasses import dataclass, replace
from functools import cache
from threading import Lock
from typing import Any

from skinsource.base.errors import InvalidInputError
from skinsource.base.quoting import quoted
from skinsource.base.work import Work
from skinsource.design.design import Design
from skinsource.design.view import View
from skinsource.engine.graph import Graph, UnknownQuantity
from skinsource.engine.quantities import new_graph, sources
from skinsource.engine.shared import Shared

#: Designs whose results are kept at a time; each takes some megabytes.
MOST_GRAPHS = 4


@dataclass(slots=True)
class _CachedGraph:
    """A graph, and the design and view that it computed last."""

    graph: Graph
    design: Design
    view: View


class Evaluator:
    """Computes quantities of designs, one after another; remembers the last few designs.

    Any thread may call; they take turns.

    Attributes
    ----------
    work
        What the latest evaluation did.
    """

    def __init__(self) -> None:
        self._lock = Lock()
        self._shared = Shared()
        self._kept: list[_CachedGraph] = []  # the latest last
        self.work = Work()

    def evaluate(
        self, design: Design, quantities: tuple[str, ...], view: View | None = None
    ) -> dict[str, Any]:
        """Return the quantities by name; see `skinsource.evaluate`."""
        if not isinstance(design, Design):
            raise InvalidInputError(f"design is {quoted(design)}, expected a Design")
        if not isinstance(view, View | None):
            raise InvalidInputError(f"view is {quoted(view)}, expected a View or None")
        for name in quantities:
            if not isinstance(name, str):
                raise InvalidInputError(f"quantity {quoted(name)} is no name of one")
        with self._lock:
            kept = self._closest(design, View() if view is None else view)
            try:
                values = kept.graph.evaluate(quantities, sources(kept.design, kept.view))
            except UnknownQuantity as error:
                raise InvalidInputError(
                    f"{error.args[0]}. See skinsource.engine.quantities."
                ) from error
            except BaseException:
                # A limb may have been replaced on disk: the next call opens it anew.
                self._kept = [entry for entry in self._kept if not _same_limb(entry.design, design)]
                raise
            self.work = replace(kept.graph.work)
            return values

    def _closest(self, design: Design, view: View) -> _CachedGraph:
        """The graph that has most of ``design`` already; a new one where none is close."""
        same_limb = [entry for entry in self._kept if _same_limb(entry.design, design)]
        closest = min(
            reversed(same_limb), key=lambda entry: len(_changed(entry.design, design)), default=None
        )
        if closest is not None and len(_changed(closest.design, design)) <= 1:
            self._kept.remove(closest)
        else:
            closest = _CachedGraph(new_graph(self._shared), design, view)
        # The input that changes stands apart, as the selected one does in the studio: the others
        # are summed once.  No number depends on which it is.
        changed = _changed(closest.design, design)
        selected = tuple(changed) or closest.view.selected_inputs
        closest.design, closest.view = design, replace(view, selected_inputs=selected)
        self._kept = [*self._kept, closest][-MOST_GRAPHS:]
        return closest


def evaluate(design: Design, *quantities: str, view: View | None = None) -> dict[str, Any]:
    """Return quantities of a design: all that the studio shows, and nothing else is computed.

    Repeated calls are quick where only one input has changed, or the view; this holds for the last
    four designs at a time.  Threads may call it; they take turns.

    Parameters
    ----------
    design
        What is played, on which limb.
    quantities
        Their names.  Among them are ``"output_levels_db"`` (72,), dB re 1 m/s²;
        ``"output_rms"`` (72,), m/s²; ``"selected_traces"`` (n_selected, n_times), m/s²;
        ``"selected_spectra"``: frequencies (n_bins,), Hz, and magnitudes (n_selected, n_bins);
        ``"selected_axis_spectra"``, the same along each axis, (n_selected, n_axes, n_bins);
        ``"response_time_s"`` (n_times,); ``"input_waveforms"``, one array per input, muted ones
        too, from its first clip on, before amplitude, or None for a muted one that cannot be
        sampled; ``"surface_levels_db"`` (rows, columns);
        ``"axis_levels_db"``, of each axis of the limb (72,), dB re 1 m/s².
    view
        Axes, method, span and selected outputs; ``View()`` where none is given.

    Returns
    -------
    dict of str to value.  Arrays are read-only: they are remembered.

    Raises
    ------
    InvalidInputError
        There is no such quantity, or an input plays what cannot be used.
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


@cache
def _evaluator() -> Evaluator:
    return Evaluator()


def _same_limb(old: Design, new: Design) -> bool:
    return (old.limb, old.limb_digest) == (new.limb, new.limb_digest)


def _changed(old: Design, new: Design) -> list[int]:
    """Ids of the inputs of ``new`` that are not as in ``old``; of all where the rest differs."""
    if old.scaling != new.scaling or old.ids != new.ids:
        return [track.id for track in new.inputs]
    return [b.id for a, b in zip(old.inputs, new.inputs, strict=True) if a != b]
