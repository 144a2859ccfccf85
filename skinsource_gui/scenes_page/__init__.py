"""The gallery of scenes."""

from typing import TYPE_CHECKING

from skinsource.base.lazy import late_names

if TYPE_CHECKING:
    from skinsource_gui.scenes_page.page import ScenesPage
else:
    __getattr__, __dir__ = late_names(__name__, {"page": "ScenesPage"})

__all__ = ["ScenesPage"]
