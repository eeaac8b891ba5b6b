"""`genc export`: a world in the formats of other tools."""

from __future__ import annotations

from pathlib import Path

import click

from genc.cli.worlds import world_file
from genc.world.export import ALL, FORMATS, check_formats, export_world


@click.command()
@click.argument("world", type=click.Path(path_type=Path))
@click.option("--to", required=True, metavar="FORMATS", help=f"Of {', '.join(FORMATS)}, separated by commas; or {ALL}.")
@click.option(
    "--out", default="out/export", show_default=True, type=click.Path(path_type=Path), help="Folder for the files."
)
def export(world: Path, to: str, out: Path) -> None:
    """Writes WORLD (a world file, or the folder of one) in the formats of other tools."""
    from genc.world.world_file import read_world

    names = check_formats(to.split(","))
    found = read_world(world_file(world))
    for files in export_world(found, out, names).values():
        for file in files:
            click.echo(f"{file}: {_size(file.stat().st_size)}")
    if len(names) < len(FORMATS) and ALL in to.lower():
        left_out = ", ".join(name for name in FORMATS if name not in names)
        click.echo(f"note: left out {left_out}: pip install 'genc[export]'", err=True)


def _size(n_bytes: int) -> str:
    return f"{n_bytes / 1e6:.1f} MB" if n_bytes >= 1e6 else f"{n_bytes / 1e3:.1f} kB"
