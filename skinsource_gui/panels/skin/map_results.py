"""From results to what the map shows."""

from collections.abc import Mapping
from dataclasses import replace
from typing import Any

from skinsource.design.comparing import match_words
from skinsource.design.design import Design
from skinsource.design.view import View
from skinsource.limbs.own_limbs import facts_of, own_map
from skinsource.limbs.surface.operator import SurfaceOperator
from skinsource_gui.panels.skin import still_values
from skinsource_gui.panels.skin.inputs.marks import marks_of
from skinsource_gui.panels.skin.map_choices import MapChoices
from skinsource_gui.panels.skin.map_content import drawn_note_of, note_of, px_per_mm_of
from skinsource_gui.panels.skin.map_display import MapDisplay
from skinsource_gui.panels.skin.map_quantity import STILL, MapQuantity
from skinsource_gui.panels.skin.time.time_view import TimeView
from skinsource_gui.widgets.map.field_image import field_image


class MapResults:
    """Makes of results what is chosen to be seen of them: what stays, or what is at the playhead.

    Parameters
    ----------
    choices
        What is chosen.
    time
        Who makes frames.
    display
        Who is told.
    """

    def __init__(self, choices: MapChoices, time: TimeView, display: MapDisplay) -> None:
        self._choices, self._time, self._display = choices, time, display
        self._surface: SurfaceOperator | None = None
        self._matched = ""

    @property
    def needs(self) -> frozenset[str]:
        """Names of the quantities that `take` reads."""
        settings = self._choices.settings
        moving, shown = self._time.needs(settings), settings.quantity
        always = frozenset({"limb_map", "limb_data", "match_gain"}) | (
            moving or still_values.needs_of(shown)
        )
        if settings.map_style == "sensors":
            return always
        on_surface = always | {"surface"}
        return on_surface if moving else on_surface | {still_values.over_skin(shown)}

    @property
    def moves(self) -> bool:
        """Whether what is shown is another thing at another time."""
        return self._choices.settings.quantity not in STILL

    def take(self, results: Mapping[str, Any], design: Design | None, view: View) -> None:
        """Take over what was computed for a design and view."""
        settings = self._choices.settings
        surface = results.get("surface") if "surface" in self.needs else None
        self._matched = match_words(results["match_gain"])
        self._time.bar.strip.show_matched(self._matched)
        self._take_limb(results, surface, design)
        self._time.take(results, settings, view)
        if self.moves:
            frames = self._time.frames
            self._display.colour_bar.follow(self._time.levels_of_largest())
            self._display.change(message="" if frames.largest > 0.0 else still_values.SILENT)
            self._time.show_state(settings, view)
        else:
            on_skin = surface is not None
            still = still_values.changes_of(settings.quantity, results, interpolated=on_skin)
            self._display.change(**still)
        self.follow(view)

    def follow(self, view: View) -> None:
        """Take the skin at the playhead, or let the range follow what stays."""
        settings, values = self._choices.settings, self._display.content.values
        if self.moves:
            self._take_frame(view)
        elif values is not None:
            self._display.colour_bar.follow(values)
        if settings.map_style == "sensors":
            # Kept, it would belong to an older design when it is shown again.
            self._display.change(field_values=None)

    def show_choice(self, design: Design | None, view: View) -> None:
        """Show what is known, as design, view and settings say it is to be seen."""
        settings, display = self._choices.settings, self._display
        limbs = (display.content.limb, "" if design is None else design.limb)
        still: dict[str, Any] = {}
        if not self.moves:
            still = {
                "quantity": MapQuantity(
                    name=settings.quantity, span=view.span, matched=self._matched
                ),
                "value_range": display.colour_bar.range_db,
                "fixed": self._choices.chosen_range is not None,
                "colours": settings.colours,
            }
        display.change(
            outputs=view.outputs,
            inputs=() if design is None else marks_of(design, view),
            sensors_shown=settings.sensors_shown,
            synthetic=any(facts_of(limb).synthetic for limb in limbs),
            **still,
        )
        display.show()

    def forget(self, message: str = "") -> None:
        """Nothing is known any more; ``message`` says why, where that is to be said."""
        self._time.frames.forget()
        nothing = {"values": None, "field_values": None}
        self._display.change(**nothing, message=message)

    def show_bare(self, design: Design | None) -> None:
        """Where nothing is computed for an own limb, show its places, not those of another.

        Of one that is missing there is nothing to show.
        """
        limb = "" if design is None else design.limb
        own, missing = own_map(limb), facts_of(limb).missing
        if not missing and (own is None or limb == self._display.content.limb):
            return
        self._surface = None
        self._display.change(
            limb_map=own,
            limb=limb,
            px_per_mm=own.hand_length_px / facts_of(limb).hand_length_mm if own else 0.0,
            field=None,
            noisy=(),
        )

    def _take_limb(
        self, results: Mapping[str, Any], surface: SurfaceOperator | None, design: Design | None
    ) -> None:
        limb, shown = results["limb_data"], self._choices.settings.quantity
        if surface is not None and surface is not self._surface:
            self._surface = surface
            self._display.change(field=field_image(surface, limb))
        self._display.change(
            limb_map=results["limb_map"],
            limb="" if design is None else design.limb,
            px_per_mm=px_per_mm_of(limb),
            note=still_values.limits_and(note_of(surface, limb), shown),
            drawn_note=still_values.limits_and(drawn_note_of(surface), shown),
        )

    def _take_frame(self, view: View) -> None:
        """Take the skin at the playhead; where it is not known yet, what was shown is late."""
        settings = self._choices.settings
        surface = self._surface if settings.map_style == "interpolated" else None
        changes = self._time.changes(settings, view, surface)
        if changes is not None:
            quantity = replace(changes["quantity"], matched=self._matched)
            self._display.change(**{**changes, "quantity": quantity})
        elif self._time.frames.known:
            self._display.set_stale(True)
