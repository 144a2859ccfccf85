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
from skinsource.method_comparison.made_up import responses_sha256
from skinsource.method_comparison.references import FILE_NAME
from skinsource.version import __version__

_CPU_INFO = Path("/proc/cpuinfo")
_THREAD_VARIABLES = ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS")


@dataclass(frozen=True, slots=True, kw_only=True)
class Fact:
    """One line of the description."""

    name: str
    value: str


def facts() -> tuple[Fact, ...]:
    """Machine, versions and hashes, as lines of text."""
    return (
        Fact(name="date", value=f"{datetime.now(UTC):%Y-%m-%d %H:%M} UTC"),
        Fact(name="SkinSource studio", value=__version__),
        Fact(name="processor", value=f"{_processor()}, {os.cpu_count()} logical cores"),
        Fact(name="system", value=platform.platform()),
        Fact(name="Python", value=f"{platform.python_version()} ({sys.implementation.name})"),
        Fact(name="NumPy, SciPy", value=f"{np.__version__}, {scipy.__version__}"),
        Fact(name="linear algebra", value=_linear_algebra()),
        Fact(name="threads", value=_threads()),
        Fact(name="SHA-256 of the responses", value=responses_sha256()),
        Fact(name="SHA-256 of the exact values", value=_sha256(data_folder() / FILE_NAME)),
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
