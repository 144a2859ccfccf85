"""What a page stands in front of where the panels of a studio are not the point."""

from PySide6.QtWidgets import QMainWindow

from skinsource import Design, View
from skinsource.engine.quantities import graphs_that_share
from skinsource_gui.pages.actions import ImportActions
from skinsource_gui.pages.files.exports import ExportActions
from skinsource_gui.pages.files.file_actions import FileActions
from skinsource_gui.pages.motion import MotionPage
from skinsource_gui.plots.pictures import Picture
from skinsource_gui.shell.playing import Playback
from skinsource_gui.state.document import Document
from skinsource_gui.state.engine import Engine
from skinsource_gui.state.job_runner import JobRunner
from skinsource_gui.state.panel import PanelRegistry
from skinsource_gui.state.preferences import InstalledLimbs, Preferences, start_design
from skinsource_gui.state.services import Services


class Desk(QMainWindow):
    """A document and what opens pages on it, put together as a window does it.

    A window makes all panels besides, arranges and paints them, which takes longer than most tests
    of a page.  That its menu leads to the pages is seen in a window.
    """

    def __init__(self, preferences: Preferences, design: Design | None, view: View | None) -> None:
        super().__init__()
        self.document = Document(design or start_design("synthetic-1"), view, self)
        self.runner = JobRunner(self)
        self.files = FileActions(self.document, preferences, self, lambda: b"")
        services = Services(
            window=self,
            document=self.document,
            engine=Engine(graphs_that_share(), self),
            panels=PanelRegistry({}),
            runner=self.runner,
            preferences=preferences,
            limbs=InstalledLimbs((), self.document, self),
        )
        self.imports = ImportActions(services)
        self.playback = Playback(self.document, preferences, self)
        self.exports = ExportActions(services, self.files, lambda _: Picture(draw=id))

    def show_motion(self) -> MotionPage:
        """Open the page of motions."""
        page = MotionPage(self.document, self)
        page.open()
        return page

    def end(self) -> None:
        """Let go of devices, pages and threads."""
        for owner in (self.playback, self.imports, self.exports):
            owner.end()
        self.runner.close()
        self.close()
