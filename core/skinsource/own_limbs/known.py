"""What is known of each limb, by its name: without its responses, and again only if it changed."""

import os
from functools import lru_cache
from pathlib import Path

from skinsource.counting import counted
from skinsource.errors import InvalidInputError, SkinSourceError
from skinsource.limb import BAND_HZ, PUBLISHED, Axes, Band, LimbFacts, LimbMap, axes_of, words
from skinsource.own_limbs.content import is_free_name
from skinsource.own_limbs.limb_file import LimbFile
from skinsource.own_limbs.store import own_limb_path
from skinsource.quoting import quoted


def facts_of(name: str) -> LimbFacts:
    """Names and sizes of a limb; of one that is not here, or damaged, sizes of the published ones.

    Where none is named, all is that of the published ones.
    Quick enough for each edit: a file is read again only after it has changed.
    """
    published = PUBLISHED.get(name)
    if published is not None:
        return published
    if is_free_name(name):
        path = own_limb_path(name)
        try:
            about = path.stat()
            return _read(name, path, _state_of(about))[0]
        except (OSError, SkinSourceError):
            pass
    band_hz = None if name else BAND_HZ
    return LimbFacts(name=name, title=name, sentence="", band_hz=band_hz, known=False)


def axes_on(limb: str, axes: Axes) -> Axes:
    """These axes, or all of a limb that was not measured along each of them."""
    measured = facts_of(limb).axes
    try:
        return axes_of(measured, axes)
    except InvalidInputError:
        return measured


def outputs_on(limb: str, outputs: tuple[int, ...]) -> tuple[int, ...]:
    """Those of these outputs that a limb has; where it has none of them, as many of its first."""
    facts = facts_of(limb)
    if not facts.known:
        return outputs
    found = tuple(number for number in outputs if number <= facts.n_outputs)
    return found or tuple(range(1, min(len(outputs), facts.n_outputs) + 1))


def drive_unit_known(name: str, digest: str = "") -> bool:
    """Whether it is known what the responses of a limb answer: the probe, whose drive is in m/s².

    Not of a limb of a lab's own that answers a drive, nor of one that is not here.

    Parameters
    ----------
    name, digest
        Of the limb, as of a design.
    """
    facts = facts_of(name)
    other = facts.own and bool(digest) and facts.digest != digest
    return not (facts.missing or facts.per_unit_drive or other)


def own_map(name: str) -> LimbMap | None:
    """The map of an own limb, as quickly; None of others, and of one that is not here."""
    if not facts_of(name).own:
        return None
    path = own_limb_path(name)
    try:
        about = path.stat()
        return _read(name, path, _state_of(about))[1]
    except (OSError, SkinSourceError):
        return None


def missing_limb(name: str, digest: str) -> str:
    """Why a design of this limb cannot be computed here, in a sentence; empty if it can.

    Parameters
    ----------
    name, digest
        Of the limb, as of a design.  Where a measured limb is not installed is not said here.
    """
    facts = facts_of(name)
    if not facts.known:
        return (
            f"The limb {quoted(name)} of this design is not here. Import it (File > Own limbs…), "
            "or choose another one."
        )
    if facts.own and digest and facts.digest != digest:
        return (
            f"The limb {quoted(name)} here is another one than that of this design: it has other "
            "numbers. Import the right one, or choose this one anew."
        )
    return ""


def _band_words(band_hz: Band | None) -> str:
    return "" if band_hz is None else f", measured from {band_hz[0]:g} to {band_hz[1]:g} Hz"


def _state_of(about: os.stat_result) -> tuple[int, ...]:
    """What differs wherever a file took the place of another.

    Its time alone does not: the clock of a file system ticks a few milliseconds apart, and copies
    keep the time of what was copied.
    """
    return about.st_mtime_ns, about.st_ctime_ns, about.st_size, about.st_ino


@lru_cache(maxsize=64)
def _read(name: str, path: Path, _state: tuple[int, ...]) -> tuple[LimbFacts, LimbMap]:
    file = LimbFile(path)
    held = file.limb
    hand = f"{'Left' if held.left else 'Right'} hand{', shown mirrored' if held.mirrored else ''}"
    facts = LimbFacts(
        name=name,
        title=held.title or name,
        sentence=f"{hand}, imported: {counted(held.n_inputs, 'place')}, "
        f"{counted(held.n_outputs, 'output')} along "
        f"{words(held.axes)}, {held.sample_rate_hz:g} Hz{_band_words(held.band_hz)}.",
        n_inputs=held.n_inputs,
        n_outputs=held.n_outputs,
        n_taps=held.n_taps,
        axes=held.axes,
        sample_rate_hz=held.sample_rate_hz,
        pre_trigger_delay_s=held.pre_trigger_delay_s,
        band_hz=held.band_hz,
        hand_length_mm=held.hand_length_mm,
        per_unit_drive=held.per_unit_drive,
        synthetic=held.synthetic,
        own=True,
        input_names=held.input_names,
        output_names=held.output_names,
        digest=file.digest,
        left=held.left,
        mirrored=held.mirrored,
    )
    return facts, held.map()
