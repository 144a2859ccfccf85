"""Edit > Save to library…: what is kept, and under which name; and presets that are dropped."""

from typing import TYPE_CHECKING

from skinsource.base.lazy import late_names

if TYPE_CHECKING:
    from skinsource_gui.library_page.preset_choices import choices
    from skinsource_gui.library_page.save_page import SavePage
else:
    __getattr__, __dir__ = late_names(
        __name__, {"preset_choices": "choices", "save_page": "SavePage"}
    )

__all__ = ["SavePage", "choices"]
