"""The engines that are measured, with the settings of each."""

from collections.abc import Callable
from dataclasses import dataclass

from skinsource.method_comparison import cached_spectra, direct, overlap_add, program, scipy_signal
from skinsource.method_comparison.method import Method, Precision, Prepared, Setting
from skinsource.method_comparison.scenes import ComparedScene


@dataclass(frozen=True, slots=True, kw_only=True)
class ComparedEngine:
    """A way of computing scenes.

    Attributes
    ----------
    name
        Words for people.
    prepare
        Makes it ready for a scene; raises `Unfit` where it cannot compute it.
    methods
        What it is measured with.
    is_ours
        Whether it is what the program runs, so that the promises are its own.
    family
        Scenes of the same family are computed.
    """

    name: str
    prepare: Callable[[ComparedScene, Method], Prepared]
    methods: tuple[Method, ...]
    is_ours: bool = False
    family: str = "convolution"

    def method_of(self, precision: str, setting: str) -> Method:
        """Return the method with this precision and setting."""
        return next(
            one for one in self.methods if (one.precision, one.setting.name) == (precision, setting)
        )


_BOTH_PRECISIONS: tuple[Precision, ...] = ("float64", "float32")
_EXACT = tuple(Method(precision=precision, in_quick=True) for precision in _BOTH_PRECISIONS)
_CUTS = tuple(
    Method(setting=Setting(name=f"cut {db:g} dB", cut_db=db), in_quick=db == -80.0)
    for db in (-60.0, -80.0, -100.0)
)
_RANKS = tuple(
    Method(setting=Setting(name=f"rank {rank}", rank=rank), in_quick=rank == 32)
    for rank in (16, 32, 64)
)
_SHORT_BLOCKS = tuple(
    Method(setting=Setting(name=f"block {block}", block=block)) for block in (1024, 16384)
)

ENGINES = (
    ComparedEngine(
        name="this program",
        prepare=program.prepare,
        methods=(
            Method(setting=Setting(name="map and 6 traces", what="window"), in_quick=True),
            Method(setting=Setting(name="all channels"), in_quick=True),
            Method(setting=Setting(name="predict()", what="library"), in_quick=True),
            Method(precision="float32", setting=Setting(name="map and 6 traces", what="window")),
        ),
        is_ours=True,
    ),
    ComparedEngine(
        name="cached spectra",
        prepare=cached_spectra.prepare,
        methods=(*_EXACT, *_CUTS, *_RANKS),
    ),
    ComparedEngine(
        name="overlap-add",
        prepare=overlap_add.prepare,
        methods=(*_EXACT, *_CUTS, *_SHORT_BLOCKS),
    ),
    ComparedEngine(name="direct", prepare=direct.prepare, methods=(*_EXACT, *_CUTS)),
    ComparedEngine(name="fftconvolve", prepare=scipy_signal.prepare_fftconvolve, methods=_EXACT),
    ComparedEngine(name="oaconvolve", prepare=scipy_signal.prepare_oaconvolve, methods=_EXACT),
)


def engine_of(name: str) -> ComparedEngine:
    """Return the engine called ``name``."""
    return next(engine for engine in ENGINES if engine.name == name)
