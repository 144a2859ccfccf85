"""A quantity of a design with its axes, units and labels, which draws itself."""

from __future__ import annotations

import importlib
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from skinsource.base.arguments import checking
from skinsource.base.conventions import Floats
from skinsource.base.errors import InvalidInputError, quoted
from skinsource.base.extras import package_of_extra
from skinsource.design.design import Design, View
from skinsource.design.labels import limb_label, signal_label, span_label
from skinsource.engine.evaluation import Quantity, evaluate, quantities
from skinsource.engine.quantities import new_graph
from skinsource.export import plot


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Result:
    """A quantity of a design, or the difference of two.

    Attributes
    ----------
    name, unit, label
        Of the quantity: ``"output_levels_db"``, ``"dB re 1 m/s²"``, and what it is.
    values
        Array in the order of ``axes``; its `numpy.asarray` is the result's.
    axes
        Coordinates by the name of the dimension: numbers of outputs, from 1; names of axes; times,
        s; frequencies, Hz; numbers of windows, from 1; positions of rows and columns, mm.
    design, view
        Of what, and how it is looked at; of a difference, those of the first result.
    is_difference
        Whether it is a difference of two results.
    """

    name: str
    unit: str
    label: str
    values: Floats
    axes: dict[str, np.ndarray]
    design: Design
    view: View
    is_difference: bool = False

    def __repr__(self) -> str:
        size = " x ".join(f"{len(along)} {name}" for name, along in self.axes.items())
        return f"<Result {self.name}: {size or self.values} in {self.unit or 'no unit'}>"

    def _repr_html_(self) -> str:
        """Return the HTML that a notebook shows."""
        return importlib.import_module("skinsource.export.displaying").html_of(self)

    def __array__(self, dtype: Any = None, copy: bool | None = None) -> np.ndarray:
        return np.array(self.values, dtype=dtype, copy=copy)

    def __sub__(self, other: Result) -> Result:
        """Return the difference, whose map diverges."""
        if not isinstance(other, Result) or (other.name, other.values.shape) != (
            self.name,
            self.values.shape,
        ):
            raise InvalidInputError(f"{quoted(other)} is no {self.name} of this shape; use one")
        return replace(
            self,
            values=self.values - other.values,
            unit="dB" if self.unit.startswith("dB") else self.unit,
            label=f"Difference of: {self.label}"
            + ("" if other.label == self.label else f"; minus: {other.label}"),
            is_difference=True,
        )

    def plot_map(self, **how: Any) -> Any:
        """Draw it over hand and arm, see `skinsource.plot.map`, and return the figure.

        Raises
        ------
        InvalidInputError
            It is no number for each output.
        """
        if tuple(self.axes) != ("n_outputs",):
            raise InvalidInputError(
                f"{self.name} has the dimensions {', '.join(self.axes) or 'of a number'}, expected "
                "a number for each output, such as output_levels_db"
            )
        if not self.is_difference and self.name == "output_levels_db":
            return plot.map(self.design, view=self.view, **how)
        # From 0 on where they are accelerations.
        levels = self.is_difference or self.unit.startswith("dB")
        return plot.map(
            self.values,
            limb=self.design.limb,
            **{
                "label": f"{'difference ' if self.is_difference else ''}({self.unit})",
                "colours": "diverging" if self.is_difference else "sequential",
                "range_db": None if levels else (0.0, float(self.values.max()) or 1.0),
                **how,
            },
        )

    def plot_traces(self, outputs: Sequence[int] | None = None, **how: Any) -> Any:
        """Draw the signals of outputs, those of the view unless given, and return the figure.

        See `skinsource.plot.traces`.
        """
        return plot.traces(self.design, view=self.view, outputs=outputs, **how)

    def to_dataframe(self) -> Any:
        """Return a pandas DataFrame with a column for each dimension, and one of the values.

        Raises
        ------
        MissingExtraError
            pandas is not installed.
        """
        pandas: Any = package_of_extra("pandas", "pandas")
        grids = np.meshgrid(*self.axes.values(), indexing="ij")
        columns = {
            _COLUMNS[name]: grid.ravel() for name, grid in zip(self.axes, grids, strict=True)
        }
        return pandas.DataFrame({**columns, self.name: np.ravel(self.values)})


# Names of columns of tables.
_COLUMNS = {
    "n_outputs": "output",
    "n_selected": "output",
    "n_axes": "axis",
    "n_times": "time_s",
    "n_bins": "frequency_hz",
    "n_windows": "window",
    "rows": "y_mm",
    "columns": "x_mm",
}


@checking
def result(
    design: Design, quantity: str = "output_levels_db", *, view: View | None = None
) -> Result:
    """Return a quantity of a design with axes, unit and label, which draws itself.

    Parameters
    ----------
    design
        The stimulus, and the limb.
    quantity
        Name of a quantity that `skinsource.quantities` lists.
    view
        Axes, method, span and selected outputs; by default ``View()``.

    Raises
    ------
    InvalidInputError
        There is no such quantity, it is not known of this design, or an input cannot be played.

    Examples
    --------
    >>> import skinsource as ss
    >>> tone = ss.track(7, ss.waveforms.Tone(frequency_hz=100.0))
    >>> levels = ss.result(ss.Design(limb="synthetic-1", inputs=(tone,)))
    >>> levels
    <Result output_levels_db: 72 n_outputs in dB re 1 m/s²>
    >>> figure = levels.plot_map()
    """
    view = View() if view is None else view
    listed: dict[str, Quantity] = {each.name: each for each in quantities()}
    values = evaluate(design, quantity, *_AXIS_SOURCES, view=view)
    if quantity not in listed:
        raise InvalidInputError(f"{quantity} is not an array; see skinsource.quantities()")
    about, value, frequency_hz = listed[quantity], values[quantity], np.empty(0)
    if value is None:
        raise InvalidInputError(f"{quantity} is unknown for this design; choose another quantity")
    if "n_bins" in about.shape:
        frequency_hz, value = value
    array = np.asarray(value)
    limb, surface = values["limb_data"], values["surface"]
    # A spectrum or a window has as many entries as the values have.
    along = {
        "n_outputs": np.arange(1, limb.n_outputs + 1),
        "n_selected": np.array(values["shown_outputs"], int),
        "n_axes": np.array(list(limb.axes if quantity in _ALL_AXES else _chosen(values))),
        "n_times": values["response_time_s"],
        "n_bins": frequency_hz,
        "n_windows": np.arange(1, len(array) + 1) if array.ndim else np.empty(0),
        "rows": surface.y_mm,
        "columns": surface.x_mm,
    }
    depends = new_graph().upstream_of({quantity})
    seen = [
        f"{about.about} {limb_label(design.limb).title}",
        *([signal_label(view.axes, view.method)] if _projected(quantity, depends) else []),
        *([span_label(view.span)] if "span" in depends else []),
    ]
    return Result(
        name=quantity,
        unit=about.unit,
        label="; ".join(seen),
        values=array,
        axes={name: along[name] for name in about.shape},
        design=design,
        view=view,
    )


_AXIS_SOURCES = ("limb_data", "surface", "shown_outputs", "axis_numbers", "response_time_s")
# Quantities along every axis of the limb, whichever are chosen.
_ALL_AXES = (
    "axis_levels_db",
    "axis_record_rms",
    "axis_surface_levels_db",
    "selected_axis_spectra",
    "selected_axis_peak_spectra",
)


def _projected(quantity: str, depends: frozenset[str]) -> bool:
    """Return whether axes became one signal, in a quantity that ``depends`` on others."""
    return "method" in depends and quantity not in _ALL_AXES


def _chosen(values: dict[str, Any]) -> list[str]:
    return [values["limb_data"].axes[number] for number in values["axis_numbers"]]
