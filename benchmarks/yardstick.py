"""Fixed pieces of work, timed beside what is promised: on a slow or busy machine both take longer.

An absolute time is reported; what a benchmark fails on is its ratio to one of these, measured in
turn with it in the same run.
"""

import statistics
from collections.abc import Callable
from functools import cache, partial
from time import perf_counter

import numpy as np
import scipy.fft
from PySide6.QtCore import QPointF, QRectF, Qt
from PySide6.QtGui import QColor, QImage, QPainter, QPolygonF

_SHARE = "{label} {value:.1f} {unit}: {ratio:.2f} x {beside} of {reference:.1f} {unit} beside it "


@cache
def _signals() -> np.ndarray:
    return np.random.default_rng(1).standard_normal((108, 2048))


def transforms() -> None:
    """Transform 108 signals of 2048 samples there and back."""
    spectra = scipy.fft.rfft(_signals())
    spectra *= spectra
    scipy.fft.irfft(spectra)


@cache
def _curves() -> tuple[QImage, tuple[QPolygonF, ...]]:
    x, random = np.linspace(0.0, 1440.0, 200), np.random.default_rng(2)
    lines = (450.0 + 200.0 * random.standard_normal(x.size) for _ in range(3))
    points = (map(QPointF, x.tolist(), line.tolist()) for line in lines)
    return QImage(1440, 900, QImage.Format.Format_RGB32), tuple(QPolygonF(list(p)) for p in points)


def painting() -> None:
    """Paint a window's size: its ground, three noisy curves, a hundred circles."""
    image, curves = _curves()
    painter = QPainter(image)
    painter.setRenderHint(QPainter.RenderHint.Antialiasing)
    painter.fillRect(image.rect(), Qt.GlobalColor.white)
    painter.setPen(QColor("navy"))
    for curve in curves:
        painter.drawPolyline(curve)
    for k in range(100):
        painter.drawEllipse(QRectF(14.0 * k, 8.0 * k, 30.0, 30.0))
    painter.end()


def computing_and_painting() -> None:
    """Do both, one after the other."""
    transforms()
    painting()


def timed(work: Callable[[], object], clock: Callable[[], float] = perf_counter) -> float:
    """Seconds that ``work`` takes by a clock."""
    begin = clock()
    work()
    return clock() - begin


class Beside:
    """Times a fixed piece of work again and again, between what it is compared with.

    By the clock on the wall, or by that of the processor.
    """

    def __init__(
        self,
        work: Callable[[], object],
        label: str,
        clock: Callable[[], float] = perf_counter,
    ) -> None:
        self._time, self.label = partial(timed, work, clock), label
        self._time()  # what is made once
        self.times_s: list[float] = []

    def once(self) -> None:
        """Time it once more."""
        self.times_s.append(self._time())

    @property
    def median_s(self) -> float:
        """Median of the times so far."""
        return statistics.median(self.times_s)

    def judge(self, label: str, seconds: float, most: float) -> bool:
        """Print a time and its ratio; whether the ratio is kept."""
        return judge(label, 1e3 * seconds, "ms", (self.label, 1e3 * self.median_s), most)


def judge(label: str, value: float, unit: str, beside: tuple[str, float], most: float) -> bool:
    """Print a figure and its ratio to one ``beside`` it; whether that is at most ``most``."""
    name, reference = beside
    ratio = value / reference
    holds = ratio <= most
    line = _SHARE.format(
        label=label, value=value, unit=unit, ratio=ratio, beside=name, reference=reference
    )
    print(f"{line}(promised: {most:g}): {'kept' if holds else 'BROKEN'}")
    return holds
