"""A film as MP4, WebM or GIF, written whole or not at all; it needs the extra ``video``."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from skinsource.base.errors import InvalidInputError, StorageError, printable, quoted
from skinsource.base.extras import package_of_extra
from skinsource.base.files import replacing
from skinsource.base.job import Stop, stop_if

#: Adds one frame, (rows, columns, 3) of uint8.
AddFrame = Callable[[NDArray[np.uint8]], None]


class _Kind(NamedTuple):
    """How frames are encoded."""

    frames_per_s: int
    codec: str
    options: tuple[str, ...]


_H264 = ("-crf", "18", "-preset", "medium", "-movflags", "+faststart")
_VP9 = ("-crf", "24", "-b:v", "0", "-row-mt", "1", "-cpu-used", "4")
_PALETTE = (
    "split[a][b];[a]trim=end_frame=50,palettegen=stats_mode=full[p];[b][p]paletteuse=dither=none"
)
_KINDS = {
    # Plays everywhere; the index is at the beginning of the file, so that it starts at once.
    ".mp4": _Kind(60, "libx264", (*_H264, "-pix_fmt", "yuv420p")),
    ".webm": _Kind(60, "libvpx-vp9", (*_VP9, "-pix_fmt", "yuv420p")),
    # A GIF counts in hundredths of a second.  Its colours are those of its first second, which
    # shows the colour bar: for colours of all frames the encoder would hold all until the end.
    ".gif": _Kind(50, "gif", ("-filter_complex", _PALETTE)),
}
#: Endings of file names.
ENDINGS = tuple(_KINDS)


def frames_per_s(path: Path) -> int:
    """Return the frames per second of a file with this ending.

    Raises
    ------
    InvalidInputError
        No animation ends so.
    """
    return _kind_of(path).frames_per_s


@contextmanager
def video_file(path: Path, size: tuple[int, int], about: str, stop: Stop) -> Iterator[AddFrame]:
    """Give a function that adds frames to a film, which replaces ``path`` at the end.

    Parameters
    ----------
    path
        The file; its ending is ``.mp4``, ``.webm`` or ``.gif``.
    size
        Width and height of all frames, px, even numbers.
    about
        Comment within the file.
    stop
        Asked at each frame; once true, `skinsource.base.errors.Stopped` is raised.

    Raises
    ------
    MissingExtraError
        The extra ``video`` is not installed.
    InvalidInputError
        No animation ends so, or the size is not even.
    StorageError
        The folder cannot be written, or the disk is full.
    Stopped
        ``stop`` said so; nothing is left.
    """
    kind = _kind_of(path)
    if any(side < 2 or side % 2 for side in size):
        raise InvalidInputError(f"the frames have the size {size}, expected even numbers of pixels")
    with replacing(path) as temporary:
        encoder = package_of_extra("imageio_ffmpeg", "video")
        described = ("-metadata", f"comment={printable(about)[:500]}")
        writer = encoder.write_frames(
            str(temporary),
            size,
            fps=kind.frames_per_s,
            codec=kind.codec,
            pix_fmt_out="pal8" if kind.codec == "gif" else "yuv420p",
            macro_block_size=1,
            quality=None,
            ffmpeg_log_level="error",
            output_params=[*kind.options, *described, "-f", path.suffix.lower()[1:]],
        )
        try:
            writer.send(None)

            def add(frame: NDArray[np.uint8]) -> None:
                stop_if(stop)
                writer.send(np.ascontiguousarray(frame))

            yield add
            writer.close()
        except OSError as error:
            raise _write_error(path, error) from error
        finally:
            with suppress(OSError):
                writer.close()
        stop_if(stop)
        if temporary.stat().st_size == 0:
            raise _write_error(path, OSError("the encoder wrote nothing"))


def _kind_of(path: Path) -> _Kind:
    kind = _KINDS.get(path.suffix.lower())
    if kind is None:
        raise InvalidInputError(
            f"{quoted(path.name)} does not say what to write, expected a name that ends in "
            f"{', '.join(ENDINGS)}"
        )
    return kind


def _write_error(path: Path, error: OSError) -> StorageError:
    reason = " ".join(printable(error).split())[-300:]
    return StorageError(
        f"{path}: the animation could not be written ({reason}). Free some space, or choose "
        "another folder or format."
    )
