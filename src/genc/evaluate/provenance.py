"""What a figure was made with: versions and machine."""

from __future__ import annotations

import os
import platform
from importlib.metadata import version
from importlib.util import find_spec
from pathlib import Path

from genc.errors import ExtraError
from genc.evaluate.material import Facts

PACKAGES = ("genc", "numpy", "scipy", "torch", "scikit-learn")


def check_extra() -> None:
    """Raises `ExtraError` unless what evaluation draws and classifies with is installed."""
    if any(find_spec(name) is None for name in ("matplotlib", "sklearn")):
        raise ExtraError("an evaluation", "evaluate")


def provenance() -> Facts:
    """Versions, platform and processor of this process."""
    versions = {name: version(name) for name in PACKAGES}
    return {
        "versions": ", ".join(f"{name} {number}" for name, number in versions.items()),
        "platform": f"Python {platform.python_version()}, {platform.platform()}",
        "processor": f"{_processor()}, {os.cpu_count()} logical cores",
    }


def _processor() -> str:
    """Its name where the system tells one, else its architecture."""
    try:
        lines = Path("/proc/cpuinfo").read_text(encoding="utf-8").splitlines()
    except OSError:
        lines = []
    named = (line.partition(":")[2].strip() for line in lines if line.startswith("model name"))
    return next(named, platform.processor() or platform.machine())
