"""Along which direction each selected output moves most."""

from collections.abc import Mapping
from typing import Any, ClassVar

import numpy as np
from PySide6.QtWidgets import QWidget

from skinsource.design.design import Design
from skinsource.design.view import View
from skinsource_gui.figure_panel import SILENT, FigurePanel
from skinsource_gui.panels.main_axis.picture import MainAxisPicture, Shown
from skinsource_gui.widgets.copied_numbers import copied

_SINGLE = "A single axis has no main axis: choose two or three axes above"
_ALONG_ONE = "A single axis has no main axis, and this limb was measured along one alone"
_ABOUT = "Ellipses of one standard deviation; the line is the main axis"
_OWN = "x and y point another way at each sensor"


class MainAxisPanel(FigurePanel):
    """The ellipse of motion of each selected output, and its main axis where it has one."""

    title: ClassVar[str] = "Main axis"
    name: ClassVar[str] = "main_axis"

    def __init__(self, parent: QWidget | None = None) -> None:
        self.picture = MainAxisPicture()
        super().__init__(self.picture, parent)
        self.about = self.add_above("main_axis_about")
        self.about.say(_ABOUT)
        self.about.setToolTip(f"{_ABOUT}. {_OWN}.")
        self.choices.addWidget(self.about, 1)
        self.copy = self.add_copy(self.table)
        self.say_instead(self.no_outputs)

    @property
    def needs(self) -> frozenset[str]:
        return frozenset({"output_main_axes", "shown_outputs", "axis_numbers", "limb_data"})

    def show_state(self, design: Design, view: View) -> None:
        if not view.outputs:
            self.say_instead(self.no_outputs)
        elif self.figure.message == self.no_outputs:
            self.await_results()

    def show_results(self, results: Mapping[str, Any]) -> None:
        if not results["shown_outputs"]:
            self.say_instead(self.no_outputs)
        elif results["output_main_axes"] is None:
            self.say_instead(_SINGLE if results["limb_data"].n_axes > 1 else _ALONG_ONE)
        elif np.isnan(results["output_main_axes"].share).all():
            self.say_instead(SILENT)
        else:
            limb = results["limb_data"]
            self.copy.offer(True)
            self.picture.show_axes(
                Shown(
                    found=results["output_main_axes"],
                    outputs=results["shown_outputs"],
                    axes="".join(limb.axes[k] for k in results["axis_numbers"]),
                    limb=limb.name,
                )
            )
            # How the sensors of an own limb lie is not known.
            words = [_OWN] if limb.map.axes_shown else []
            words += ["synthetic limb"] if limb.synthetic else []
            self.show_found(" · ".join(words))

    def table(self) -> str:
        """The numbers, with tabs between the columns."""
        shown = self.picture.shown
        if shown is None or self.picture.message:
            return ""
        n_axes = len(shown.axes)
        header = ["output", *(f"direction_{axis}" for axis in shown.axes)]
        header += [f"deviation_{k}_m_per_s2" for k in range(1, n_axes + 1)]
        header += ["share_of_variance", "main_axis"]
        lines = ["\t".join(header)]
        found = shown.found
        for rank, output in enumerate(shown.outputs):
            numbers = (*found.direction[rank], *found.deviation[rank], found.share[rank])
            said = "no" if found.none[rank] else "yes"
            lines.append("\t".join((str(output), *map(copied, numbers), said)))
        return "\n".join(lines) + "\n"
