"""`genc render`: a still picture of a world."""

from __future__ import annotations

from pathlib import Path

import click

from genc.cli.worlds import world_file


@click.command()
@click.argument("world", type=click.Path(path_type=Path))
@click.option("--at", "at_s", default=120.0, show_default=True, help="The moment, in seconds.")
@click.option("--out", default="shot.png", show_default=True, type=click.Path(path_type=Path), help="The picture, PNG.")
@click.option("--width", default=1600, show_default=True, help="Pixels.")
@click.option("--height", default=900, show_default=True, help="Pixels.")
@click.option("--view", default="overview", show_default=True, help="overview, top or street.")
@click.option("--theme", default="light", show_default=True, help="light or dark.")
@click.option("--agent", default=None, type=int, help="Mark this person.")
@click.option("--names/--no-names", default=True, show_default=True, help="Name the places.")
@click.option("--plain", is_flag=True, help="A plain plan from above, without a browser.")
def render(  # noqa: PLR0913 - one parameter for each option
    world: Path,
    at_s: float,
    out: Path,
    width: int,
    height: int,
    view: str,
    theme: str,
    agent: int | None,
    names: bool,
    plain: bool,
) -> None:
    """Takes a picture of WORLD (a world file, or the folder of one): by headless Chromium, else a plan from above."""
    from genc.world.picture import BROWSERS, Shot, take_picture

    shot = Shot(at_s, width, height, view, theme, agent, names)
    if not take_picture(world_file(world), out, shot, plain=plain) and not plain:
        click.echo(f"note: no browser could take it ({', '.join(BROWSERS)}), so this is the plain plan", err=True)
    click.echo(str(out))
