"""Files that are there whole or not at all.

Room: files. In: a path. Out: a file or folder that appears in one rename. May import: errors. Never: formats.
"""

from __future__ import annotations

import os
import shutil
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from genc.errors import OutputError


@contextmanager
def written_beside(path: Path | str) -> Iterator[Path]:
    """A path beside `path` to write to; it takes the place of `path` when the block ends well, else it is removed.

    Raises:
        OutputError: if nothing can be written there.
    """
    target = Path(path)
    beside = target.parent / f".{target.name}.{os.getpid()}.part"
    try:
        target.parent.mkdir(parents=True, exist_ok=True)
        yield beside
        beside.replace(target)
    except OSError as error:
        raise OutputError(f"{target} cannot be written ({error.strerror or error}); name another place") from error
    finally:
        # os.path, for it takes a name that is too long for one that is not there
        if os.path.isdir(beside):
            shutil.rmtree(beside, ignore_errors=True)
        elif os.path.exists(beside):
            beside.unlink()


def write_text(path: Path | str, text: str) -> None:
    """Writes a text file whole.

    Raises:
        OutputError: if it cannot be written.
    """
    with written_beside(path) as beside:
        beside.write_text(text, encoding="utf-8")


def ensure_folder(path: Path | str) -> Path:
    """The folder, made if need be, after a test that files can be written in it.

    Raises:
        OutputError: if it cannot be made or written to.
    """
    folder = Path(path)
    try:
        folder.mkdir(parents=True, exist_ok=True)
        probe = folder / f".probe.{os.getpid()}"
        probe.touch()
        probe.unlink()
    except OSError as error:
        raise OutputError(f"{folder} cannot be written to ({error.strerror or error}); name another folder") from error
    return folder
