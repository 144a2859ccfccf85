"""The one table of panels: the window makes, places and lists them from it."""

from collections.abc import Mapping
from dataclasses import dataclass, field, fields

from skinsource.engine.actuator_demand import ActuatorSettings
from skinsource.specs.models import specs_of
from skinsource_gui.panels.analysis.settings import AnalysisSettings
from skinsource_gui.panels.compare.settings import CompareSettings
from skinsource_gui.panels.frequency_and_amplitude.settings import ControlSettings
from skinsource_gui.panels.skin.settings import SkinSettings
from skinsource_gui.panels.spectra.panel import SpectraSettings
from skinsource_gui.panels.timeline.content import TimelineSettings
from skinsource_gui.panels.traces.panel import TracesSettings
from skinsource_gui.shell.arrangement_spec import ARRANGEMENTS, Behind, Place
from skinsource_gui.state.panel import LazyPanel, Panel


@dataclass(frozen=True, slots=True, kw_only=True)
class PanelSpec:
    """One panel.

    Attributes
    ----------
    panel
        What makes it: a `LazyPanel`, so that its modules are imported when it is first used, or
        its class.
    settings
        Class of what only it looks at, a frozen dataclass made with `skinsource.specs.fields`; None
        where there is nothing.
    places
        Where it stands in each arrangement, by name; None: hidden, and once it is wanted a tab
        with the host of that arrangement.  Where nothing is said, at the foot of the last column.
    """

    panel: LazyPanel | type[Panel]
    settings: type | None = None
    places: Mapping[str, Place | Behind | None] = field(default_factory=dict)

    def __post_init__(self) -> None:
        if not (self.panel.name and self.panel.title):
            raise ValueError(f"{self.panel!r} has no name or no title")
        if self.settings is not None:
            unsaved = {field_.name for field_ in fields(self.settings)} - set(
                specs_of(self.settings)
            )
            if unsaved:
                raise ValueError(
                    f"{self.settings.__name__} has fields that designs cannot hold: "
                    f"{', '.join(sorted(unsaved))}. Make them with skinsource.specs.fields."
                )


# No arrangement shows it: View > Panels brings it, as a tab.
_HIDDEN: Mapping[str, Place | Behind | None] = dict.fromkeys(spec.name for spec in ARRANGEMENTS)

#: In the order in which the keyboard reaches them.
PANELS: tuple[PanelSpec, ...] = (
    PanelSpec(
        panel=LazyPanel("hand", "Hand"),
        places={**_HIDDEN, "design": Place(0), "presentation": Place(0, 82)},
    ),
    PanelSpec(
        panel=LazyPanel("timeline", "Timeline"),
        settings=TimelineSettings,
        places={
            **_HIDDEN,
            "design": Place(0, 38, at_foot=True),
            "drawing": Place(0, 30, at_foot=True),
            "analysis": Behind("spectra"),
        },
    ),
    PanelSpec(panel=LazyPanel("inspector", "Inspector"), places={**_HIDDEN, "design": Place(2)}),
    PanelSpec(
        panel=LazyPanel("frequency_and_amplitude", "Frequency and amplitude"),
        settings=ControlSettings,
        places={**_HIDDEN, "presentation": Place(0, 18)},
    ),
    PanelSpec(
        panel=LazyPanel("skin", "Skin"),
        settings=SkinSettings,
        places={
            **_HIDDEN,
            "design": Place(1),
            "drawing": Place(0),
            "analysis": Place(0),
            "presentation": Place(1),
        },
    ),
    PanelSpec(
        panel=LazyPanel("traces", "Traces"),
        settings=TracesSettings,
        places={**_HIDDEN, "design": Place(3, 50), "analysis": Place(1)},
    ),
    PanelSpec(
        panel=LazyPanel("spectra", "Spectra"),
        settings=SpectraSettings,
        places={**_HIDDEN, "design": Place(3, 50), "analysis": Place(1)},
    ),
    PanelSpec(
        panel=LazyPanel("clip_editor", "Clip"),
        places={
            **_HIDDEN,
            "design": Behind("timeline"),
            "drawing": Place(1),
            "analysis": Behind("spectra"),
        },
    ),
    PanelSpec(panel=LazyPanel("compare", "Compare"), settings=CompareSettings, places=_HIDDEN),
    PanelSpec(panel=LazyPanel("history", "History"), places=_HIDDEN),
    PanelSpec(panel=LazyPanel("library", "Library"), places=_HIDDEN),
    PanelSpec(panel=LazyPanel("actuator", "Actuator"), settings=ActuatorSettings, places=_HIDDEN),
    PanelSpec(panel=LazyPanel("playback", "Playback"), places=_HIDDEN),
    PanelSpec(panel=LazyPanel("analysis", "Analysis"), settings=AnalysisSettings, places=_HIDDEN),
    PanelSpec(
        panel=LazyPanel("analysis_2", "Analysis 2", folder="analysis"),
        settings=AnalysisSettings,
        # Where the first one is seen beside it.
        places={
            "design": Behind("traces"),
            "drawing": Behind("clip_editor"),
            "analysis": Behind("traces"),
            "presentation": Behind("skin"),
        },
    ),
)
