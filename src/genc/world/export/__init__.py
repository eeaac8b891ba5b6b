"""A world in the formats of other tools; `docs/formats.md` describes each file.

In: a `World`, a folder, names of formats. Out: files, each there whole or not at all.
May import: world, motion, plan, scenario, words, files, errors. Never: what is not in the world; a library of a
format that was not asked for.
"""

from __future__ import annotations

from collections.abc import Sequence
from importlib import import_module
from importlib.util import find_spec
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

from genc.errors import BriefError, ExtraError
from genc.files import ensure_folder

if TYPE_CHECKING:
    from genc.world.world import World

ALL = "all"
"""Stands for every format whose libraries are there."""


class Format(NamedTuple):
    """How a format is written: by `write(world, folder)` of a module here, with libraries beyond the bare install."""

    module: str
    libraries: tuple[str, ...] = ()

    @property
    def available(self) -> bool:
        """Whether all its libraries are installed."""
        return all(find_spec(library) is not None for library in self.libraries)


FORMATS = {
    "jupedsim": Format("jupedsim_sqlite", ("shapely",)),
    "hdf5": Format("pedestrian_archive", ("h5py", "shapely")),
    "usd": Format("usd", ("pxr",)),
    "parquet": Format("parquet_tables", ("pyarrow",)),
    "csv": Format("csv_tables"),
    "eth-ucy": Format("eth_ucy"),
    "unity": Format("unity"),
    "unreal": Format("unreal"),
}


def export_world(world: World, folder: Path | str, formats: Sequence[str]) -> dict[str, tuple[Path, ...]]:
    """The files written for each format; all formats are checked before the first is written.

    Args:
        world: what to write.
        folder: where to; made if need be.
        formats: names out of `FORMATS`, or `ALL`.

    Raises:
        BriefError: for a format that is not known, or none.
        ExtraError: for a format whose library is not installed.
        OutputError: if the folder cannot be written to.
    """
    names = check_formats(formats)
    place = ensure_folder(folder)
    return {name: import_module(f"{__name__}.{FORMATS[name].module}").write(world, place) for name in names}


def check_formats(formats: Sequence[str]) -> tuple[str, ...]:
    """The formats that these names stand for, each once, in the order of the names.

    Raises:
        BriefError: for a format that is not known, or none.
        ExtraError: for a format whose library is not installed.
    """
    asked = [name.strip().lower() for name in formats]
    for name in asked:
        if name not in FORMATS and name != ALL:
            raise BriefError(f"there is no format {name!r}; there are {', '.join(FORMATS)}, and {ALL}")
        if name != ALL and not FORMATS[name].available:
            raise ExtraError(f"the format {name!r}", "export")
    if not asked:
        raise BriefError(f"no format was named; there are {', '.join(FORMATS)}, and {ALL}")
    present = [name for name, found in FORMATS.items() if found.available]
    return tuple(dict.fromkeys(one for name in asked for one in (present if name == ALL else [name])))
