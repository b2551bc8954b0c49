"""The compiled module: it takes the arguments of a call by their names; the signatures are those of its callers."""

from typing import Any

def __getattr__(name: str) -> Any: ...
