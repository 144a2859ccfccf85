"""The one table of panels: the window makes, places and lists them from it."""

from collections.abc import Mapping
from dataclasses import dataclass, field, fields

from skinsource.actuator_demand import ActuatorSettings
from skinsource.analysis.settings import SpectrogramSettings
from skinsource.fields import specs_of
from skinsource.perception.settings import PerceptionSettings
from skinsource_gui.panel import Panel
from skinsource_gui.panels.actuator.panel import ActuatorPanel
from skinsource_gui.panels.clip_editor.panel import ClipEditorPanel
from skinsource_gui.panels.compare.panel import ComparePanel
from skinsource_gui.panels.frequency_and_amplitude.panel import FrequencyAndAmplitudePanel
from skinsource_gui.panels.frequency_and_amplitude.settings import ControlSettings
from skinsource_gui.panels.hand.panel import HandPanel
from skinsource_gui.panels.history.panel import HistoryPanel
from skinsource_gui.panels.inspector.panel import InspectorPanel
from skinsource_gui.panels.library.panel import LibraryPanel
from skinsource_gui.panels.main_axis.panel import MainAxisPanel
from skinsource_gui.panels.perception.panel import PerceptionPanel
from skinsource_gui.panels.playback.panel import PlaybackPanel
from skinsource_gui.panels.regions.panel import RegionsPanel
from skinsource_gui.panels.side_by_side.panel import SideBySidePanel
from skinsource_gui.panels.side_by_side.settings import SideBySideSettings
from skinsource_gui.panels.skin.panel import SkinPanel
from skinsource_gui.panels.skin.settings import SkinSettings
from skinsource_gui.panels.spectra.panel import SpectraPanel
from skinsource_gui.panels.spectra.settings import SpectraSettings
from skinsource_gui.panels.spectrogram.panel import SpectrogramPanel
from skinsource_gui.panels.statistics.panel import StatisticsPanel
from skinsource_gui.panels.timeline.panel import TimelinePanel
from skinsource_gui.panels.timeline.settings import TimelineSettings
from skinsource_gui.panels.traces.panel import TracesPanel
from skinsource_gui.panels.traces.settings import TracesSettings
from skinsource_gui.panels.transfer.panel import TransferPanel
from skinsource_gui.panels.transfer.settings import TransferSettings
from skinsource_gui.panels.wave.panel import WavePanel
from skinsource_gui.panels.windowed.panel import WindowedPanel
from skinsource_gui.shell.docks.arrangements import Behind, Place


@dataclass(frozen=True, slots=True, kw_only=True)
class PanelSpec:
    """One panel.

    Attributes
    ----------
    panel
        Its class.
    settings
        Class of what only it looks at, a frozen dataclass made with `skinsource.fields`; None
        where there is nothing.
    places
        Where it stands in each arrangement, by name; None: hidden, and once it is wanted a tab
        with the host of that arrangement.  Where nothing is said, at the foot of the last column.
    """

    panel: type[Panel]
    settings: type | None = None
    places: Mapping[str, Place | Behind | None] = field(default_factory=dict)

    def __post_init__(self) -> None:
        if not (self.panel.name and self.panel.title):
            raise ValueError(f"{self.panel.__name__} has no name or no title")
        if self.settings is not None:
            unsaved = {one.name for one in fields(self.settings)} - set(specs_of(self.settings))
            if unsaved:
                raise ValueError(
                    f"{self.settings.__name__} has fields that designs cannot hold: "
                    f"{', '.join(sorted(unsaved))}. Make them with skinsource.fields."
                )


def _places(
    design: Place | Behind | None = None,
    drawing: Place | Behind | None = None,
    analysis: Place | Behind | None = None,
    presentation: Place | Behind | None = None,
) -> Mapping[str, Place | Behind | None]:
    return {
        "design": design,
        "drawing": drawing,
        "analysis": analysis,
        "presentation": presentation,
    }


#: In the order in which the keyboard reaches them.
PANELS: tuple[PanelSpec, ...] = (
    PanelSpec(
        panel=HandPanel,
        places=_places(design=Place(0), presentation=Place(0, 82)),
    ),
    PanelSpec(
        panel=TimelinePanel,
        settings=TimelineSettings,
        places=_places(
            design=Place(0, 38, at_foot=True),
            drawing=Place(0, 30, at_foot=True),
            analysis=Behind("spectra"),
        ),
    ),
    PanelSpec(panel=InspectorPanel, places=_places(design=Place(2))),
    PanelSpec(
        panel=FrequencyAndAmplitudePanel,
        settings=ControlSettings,
        places=_places(presentation=Place(0, 18)),
    ),
    PanelSpec(
        panel=SkinPanel,
        settings=SkinSettings,
        places=_places(design=Place(1), drawing=Place(0), analysis=Place(0), presentation=Place(1)),
    ),
    PanelSpec(
        panel=TracesPanel,
        settings=TracesSettings,
        places=_places(design=Place(3, 50), analysis=Place(1)),
    ),
    PanelSpec(
        panel=SpectraPanel,
        settings=SpectraSettings,
        places=_places(design=Place(3, 50), analysis=Place(1)),
    ),
    PanelSpec(
        panel=ClipEditorPanel,
        places=_places(design=Behind("timeline"), drawing=Place(1), analysis=Behind("spectra")),
    ),
    # No arrangement shows these: View > Panels brings them, as tabs.
    PanelSpec(panel=ComparePanel, places=_places()),
    PanelSpec(panel=HistoryPanel, places=_places()),
    PanelSpec(panel=LibraryPanel, places=_places()),
    PanelSpec(panel=ActuatorPanel, settings=ActuatorSettings, places=_places()),
    PanelSpec(panel=PlaybackPanel, places=_places()),
    PanelSpec(panel=StatisticsPanel, places=_places()),
    PanelSpec(panel=SpectrogramPanel, settings=SpectrogramSettings, places=_places()),
    PanelSpec(panel=TransferPanel, settings=TransferSettings, places=_places()),
    PanelSpec(panel=MainAxisPanel, places=_places()),
    PanelSpec(panel=WavePanel, places=_places()),
    PanelSpec(panel=WindowedPanel, places=_places()),
    PanelSpec(panel=RegionsPanel, places=_places()),
    PanelSpec(panel=SideBySidePanel, settings=SideBySideSettings, places=_places()),
    PanelSpec(panel=PerceptionPanel, settings=PerceptionSettings, places=_places()),
)
