"""What the figures were measured with."""

import hashlib
import os
import platform
import sys
from dataclasses import dataclass
from datetime import UTC, datetime
from pathlib import Path

import numpy as np
import scipy

from skinsource.files.assets import data_folder
from skinsource.method_comparison.compared_limb import MADE_UP, ComparedLimb, sha256_of
from skinsource.method_comparison.references import FILE_NAME
from skinsource.quoting import printable
from skinsource.version import __version__

_CPU_INFO = Path("/proc/cpuinfo")
_THREAD_VARIABLES = ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS")


@dataclass(frozen=True, slots=True, kw_only=True)
class Fact:
    """One line of the description."""

    name: str
    value: str


def facts(limb: ComparedLimb = MADE_UP, references: Path | None = None) -> tuple[Fact, ...]:
    """Machine, versions and hashes, as lines of text.

    Parameters
    ----------
    limb
        What was measured on.
    references
        File with the exact values; None: those that come with the program.
    """
    exact = data_folder() / FILE_NAME if references is None else references
    return (
        Fact(name="date", value=f"{datetime.now(UTC):%Y-%m-%d %H:%M} UTC"),
        Fact(name="SkinSource studio", value=__version__),
        Fact(name="processor", value=f"{_processor()}, {os.cpu_count()} logical cores"),
        Fact(name="system", value=platform.platform()),
        Fact(name="Python", value=f"{platform.python_version()} ({sys.implementation.name})"),
        Fact(name="NumPy, SciPy", value=f"{np.__version__}, {scipy.__version__}"),
        Fact(name="linear algebra", value=_linear_algebra()),
        Fact(name="threads", value=_threads()),
        *_about(limb),
        Fact(name="SHA-256 of the exact values", value=_sha256(exact)),
    )


def _about(limb: ComparedLimb) -> tuple[Fact, ...]:
    if limb == MADE_UP:
        return (Fact(name="SHA-256 of the responses", value=sha256_of(limb.load())),)
    return (
        Fact(name="limb", value=printable(limb.name)),
        Fact(name="shape and rate", value=limb.size),
        Fact(name="SHA-256 of the limb", value=limb.digest),
    )


def _processor() -> str:
    if _CPU_INFO.is_file():
        lines = _CPU_INFO.read_text(encoding="utf-8", errors="replace").splitlines()
        names = [line.partition(":")[2].strip() for line in lines if line.startswith("model name")]
        if names:
            return names[0]
    return platform.processor() or platform.machine()


def _linear_algebra() -> str:
    built = np.show_config(mode="dicts")
    blas = (built or {}).get("Build Dependencies", {}).get("blas", {})
    return f"{blas.get('name', 'unknown')} {blas.get('version', '')}".strip()


def _threads() -> str:
    asked = [f"{name}={os.environ[name]}" for name in _THREAD_VARIABLES if name in os.environ]
    return ", ".join(asked) or "as the libraries choose"


def _sha256(path: Path) -> str:
    return hashlib.sha256(path.read_bytes()).hexdigest()
