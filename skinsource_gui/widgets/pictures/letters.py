"""Whether the letters of a picture can be read in print."""

from functools import partial
from math import ceil

from skinsource_gui.widgets.pictures.caption import caption_px
from skinsource_gui.widgets.pictures.layouts import LAYOUTS, PER_INCH, Below
from skinsource_gui.widgets.pictures.picture_options import PictureOptions, Remark, RemarkOf
from skinsource_gui.widgets.pictures.whole_picture import Letters, WholePicture

#: Journals take no smaller ones.
SMALLEST_PT = 5.0
_POINTS = 72.0
# A width that is said is a multiple of it.
_ROUND_PX = 10


def letters_remark(picture: WholePicture) -> RemarkOf | None:
    """What says how small letters become in print; None where they keep their size."""
    letters_px, usual = picture.letters_px, picture.size_px
    if letters_px is None or usual is None:
        return None
    return partial(_remark, letters_px, usual, partial(caption_px, picture.caption))


def _remark(
    letters_px: Letters, usual: tuple[int, int], below: Below, options: PictureOptions
) -> Remark:
    size_pt = _points(letters_px, options.width_px, options.height_px)
    if size_pt >= SMALLEST_PT:
        return Remark("")
    needed_px = ceil(options.width_px * SMALLEST_PT / size_pt / _ROUND_PX) * _ROUND_PX
    large = [
        one.title
        for one in LAYOUTS
        if _points(letters_px, *one.size_px(usual, below)) >= SMALLEST_PT
    ]
    sizes = [f"a width of {needed_px} px", *large]
    choose = f"{', '.join(sizes[:-1])} or {sizes[-1]}" if large else sizes[0]
    return Remark(
        f"The smallest letters are {size_pt:.1f} pt high; to be read in print they need "
        f"{SMALLEST_PT:g} pt. Choose {choose}, hide some panels and make the window smaller, or "
        "export the panel in use.",
        warns=True,
    )


def _points(letters_px: Letters, width: int, height: int) -> float:
    return letters_px(width, height) * _POINTS / PER_INCH
