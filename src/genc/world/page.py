"""The page: one HTML file that holds a world file and the player for it, and needs nothing else.

The player is built from `player/` into the folder of that name beside this module; `docs/player.md` describes it.
"""

from __future__ import annotations

import base64
import html
import io
import json
import zipfile
from importlib.resources import files
from pathlib import Path

from genc.errors import OutputError, WorldFileError
from genc.files import written_beside

_TITLE = "<title>genc player</title>"
_HOLD = '<script type="application/octet-stream" id="world">'
_NAMELESS = "A populated world"


def write_page(world_file: Path | str, path: Path | str) -> None:
    """Writes a page that plays a world file in a browser, by double click, with no server and no network.

    The page holds the file unchanged, in base64; its title is the sentence of the world.

    Raises:
        WorldFileError: if the world file cannot be read.
        OutputError: if nothing can be written there, or this installation lacks the player.
    """
    content = _read(Path(world_file))
    title = html.escape(_sentence(content, Path(world_file)))
    page = _template().replace(_TITLE, f"<title>{title}</title>", 1)
    head, hold, tail = page.rpartition(_HOLD)
    with written_beside(path) as part, part.open("wb") as file:
        file.write((head + hold).encode())
        file.write(base64.b64encode(content))
        file.write(tail.encode())


def _read(world_file: Path) -> bytes:
    try:
        return world_file.read_bytes()
    except OSError as error:
        raise WorldFileError(f"{world_file}: the world file cannot be read ({error.strerror})") from None


def _sentence(content: bytes, world_file: Path) -> str:
    try:
        with zipfile.ZipFile(io.BytesIO(content)) as archive:
            said = json.loads(archive.read("world.json"))["provenance"].get("text")
    except (zipfile.BadZipFile, LookupError, ValueError, TypeError, AttributeError):
        raise WorldFileError(f"{world_file}: not a sound world file; write it again with genc populate") from None
    return " ".join(said.split()) if isinstance(said, str) and said.strip() else _NAMELESS


def _template() -> str:
    """The built player, with an empty place for a world."""
    built = files("genc.world").joinpath("player", "index.html")
    if not built.is_file():
        raise OutputError(f"the player is missing from this installation ({built}); install genc again")
    page = built.read_text(encoding="utf-8")
    if _TITLE not in page or _HOLD not in page:
        raise OutputError(f"the player of this installation is damaged ({built}); install genc again")
    return page
