"""Memory that was freed is kept for the next edit, and given back when it is asked for."""

import platform
import subprocess
import sys

import pytest

FREED = """
import os
from skinsource.base.allocation import give_back_freed_memory, keep_freed_memory
from skinsource.readers.reading_process import resident_bytes

keep_freed_memory()
blocks = [bytearray(2**20) for _ in range(200)]
del blocks
kept = resident_bytes(os.getpid())
give_back_freed_memory()
print(kept - resident_bytes(os.getpid()))
"""


@pytest.mark.skipif(platform.libc_ver()[0] != "glibc", reason="Only glibc can do it")
def test_freed_memory_is_given_back_on_demand():
    done = subprocess.run([sys.executable, "-c", FREED], capture_output=True, text=True, check=True)
    assert int(done.stdout) > 150e6
