"""The limb that is being put together on the page."""

from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

import numpy as np

from skinsource.base.arrays import Floats
from skinsource.limbs.limb_import import LimbSource

_NO_POINTS, _TURN = np.empty((0, 2)), np.array((1.0, -1.0))


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Draft:
    """Files and values as they are chosen.

    Attributes
    ----------
    responses
        Where the responses are; None: not chosen yet.
    shape
        Of the responses, inputs, outputs, axes and taps, as far as the file says; None: unknown.
    in_layout
        Whether the file says all that is needed.
    outline, inputs, outputs
        Points, (n, 2), as they are drawn: x right, y down where there is a photograph, else up.
    hand
        The two ends of the length of the hand, (n, 2), clicked on a photograph.
    y_down
        Whether y points down: points are pixels of a photograph.
    tables, turned
        What of these points comes from files; whether y was turned in it, since the outline is an
        SVG, where y points down, and the tables beside it are taken to do as it does.
    input_names, output_names
        From tables.
    values
        What is typed: fields of `skinsource.limbs.own_limbs.OwnLimb`.
    """

    responses: Path | None = None
    shape: tuple[int, ...] | None = None
    in_layout: bool = False
    outline: Floats = field(default_factory=_NO_POINTS.copy)
    inputs: Floats = field(default_factory=_NO_POINTS.copy)
    outputs: Floats = field(default_factory=_NO_POINTS.copy)
    hand: Floats = field(default_factory=_NO_POINTS.copy)
    y_down: bool = False
    tables: frozenset[str] = frozenset()
    turned: bool = False
    order: str = ""
    input_names: tuple[str, ...] = ()
    output_names: tuple[str, ...] = ()
    values: dict[str, Any] = field(default_factory=dict)

    def with_point(self, what: str, point: tuple[float, float]) -> "Draft":
        """With one more point of ``what``: a third end of the hand takes the place of the first."""
        points = np.vstack((getattr(self, what), [point]))
        changed: dict[str, Any] = {what: points[-2:] if what == "hand" else points}
        return replace(self, **changed)

    def with_file(self, what: str, points: Floats, *, y_down: bool) -> "Draft":
        """With the points of a file, whose y points down or, as far as it says, up."""
        if self.y_down:
            # Pixels of the photograph.
            as_clicked: dict[str, Any] = {what: points}
            return replace(self, **as_clicked)
        turned = y_down if what == "outline" else self.turned
        changed: dict[str, Any] = {what: points * _TURN if turned else points}
        if turned != self.turned:
            changed |= {one: getattr(self, one) * _TURN for one in self.tables - {what}}
        return replace(self, tables=self.tables | {what}, turned=turned, **changed)

    def with_array(self, path: Path) -> "Draft":
        """With an array for responses: what a file in the layout said of its own ones goes."""
        nothing: dict[str, Any] = {"responses": path, "shape": None, "in_layout": False}
        if self.in_layout and not self.y_down:
            for what in {"outline", "inputs", "outputs"} - self.tables:
                nothing[what] = _NO_POINTS.copy()
        return replace(self, **nothing)

    def without_last(self, what: str) -> "Draft":
        """Without the last point of ``what``."""
        return replace(self, **{what: getattr(self, what)[:-1]})

    def source(self) -> LimbSource:
        """What is imported; where nothing was chosen, the file's own values stand."""
        if self.responses is None:
            raise ValueError("no responses are chosen")
        values = dict(self.values)
        if len(self.hand) == 2:
            values["hand_length_px"] = float(np.linalg.norm(self.hand[1] - self.hand[0]))
        for name in ("input_names", "output_names"):
            if getattr(self, name):
                values[name] = getattr(self, name)
        return LimbSource(
            responses=self.responses,
            order=self.order,
            outline=self.outline if len(self.outline) else None,
            inputs=self.inputs if len(self.inputs) else None,
            outputs=self.outputs if len(self.outputs) else None,
            y_down=self.y_down,
            values=values,
        )

    def missing(self) -> str:
        """What is still to be done, in a sentence; empty: it can be tried."""
        if self.responses is None:
            return "Choose the file of the responses."
        placed = (self.inputs, self.outputs, self.outline, self.hand)
        if self.in_layout and self.y_down and not any(map(len, placed)):
            # Nothing was clicked on the photograph: what the file says stands.
            return ""
        if not self.values.get("name"):
            return "Give the limb a name."
        axes = self.values.get("axes", "")
        if self.shape and len(axes) != self.shape[2]:
            axes_there = f"{self.shape[2]} ax{'is' if self.shape[2] == 1 else 'es'}"
            return f"The responses have {axes_there}; choose as many."
        for what, index in (("inputs", 0), ("outputs", 1)):
            n, wanted = len(getattr(self, what)), self.shape[index] if self.shape else 0
            if wanted and n != wanted:
                return f"{n} of {wanted} {what} have a place: click them, or open a table."
        if self.in_layout and len(self.outline) < 3:
            return "Click the corners of the outline: the file's has another unit."
        if self.y_down and len(self.hand) != 2:
            return "Click both ends of the hand's length: fingertip and wrist."
        return ""
