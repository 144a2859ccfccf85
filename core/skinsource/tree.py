"""Trees that JSON can hold."""

from typing import Any

Tree = Any
