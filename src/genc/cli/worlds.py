"""`genc populate`, `genc stage` and `genc story`: worlds made and told."""

from __future__ import annotations

import json as json_text
import os
from pathlib import Path
from typing import TYPE_CHECKING

import click

if TYPE_CHECKING:
    from genc.world.world import World

WORLD_FILE = "world.genc"
PAGE = "world.html"

out_option = click.option(
    "--out", default="out/world", show_default=True, type=click.Path(path_type=Path), help="Folder for the world."
)
minutes_option = click.option("--minutes", default=10.0, show_default=True, help="Length of the world.")
seed_option = click.option(
    "--seed", default=0, show_default=True, type=click.IntRange(0, 2**32 - 1), help="Same seed, same bytes."
)
page_option = click.option(
    "--page/--no-page", default=True, show_default=True, help=f"Write {PAGE} too, which plays the world in a browser."
)
steering_option = click.option(
    "--steering",
    default="kinematic",
    show_default=True,
    help="What moves people: 'kinematic' (fast, through each other) or 'jupedsim' (round each other; an extra).",
)
json_option = click.option("--json", "as_json", is_flag=True, help="Print the summary as JSON.")


def world_file(world: Path) -> Path:
    """The world file that a WORLD argument names: the file itself, or the one in that folder."""
    return world / WORLD_FILE if os.path.isdir(world) else world


@click.command()
@click.argument("text")
@click.option("--agents", default=60, show_default=True, help="People, exactly.")
@click.option("--theme", default=None, help="A theme of the corpus, as 'genc corpus stats' lists them.")
@minutes_option
@seed_option
@click.option(
    "--environment", default=None, type=click.Path(path_type=Path), help="A layout: script or JSON; else the nearest."
)
@click.option("--model", default=None, type=click.Path(path_type=Path), help="A trained model; else the shipped one.")
@click.option("--guidance", default=None, type=float, help="How far the sentence steers; 1: as learned.  [default: 2]")
@steering_option
@out_option
@page_option
@json_option
def populate(  # noqa: PLR0913 - one parameter for each option
    text: str,
    agents: int,
    theme: str | None,
    minutes: float,
    seed: int,
    environment: Path | None,
    model: Path | None,
    guidance: float | None,
    steering: str,
    out: Path,
    page: bool,
    as_json: bool,
) -> None:
    """Makes a world of TEXT: one sentence that says where it is, who is there and what they do."""
    from genc.files import ensure_folder
    from genc.model.checkpoint import SHIPPED, load_generator
    from genc.pipeline import check_request, check_steering, steered
    from genc.pipeline import populate as make
    from genc.scenario.corpus import load_theme
    from genc.scenario.exchange import read_environment

    check_request(text, agents, minutes)
    check_steering(steering)
    if theme is not None:
        load_theme(theme)
    layout = None if environment is None else read_environment(environment)
    generator = steered(load_generator(SHIPPED if model is None else model), guidance)
    ensure_folder(out)
    world = make(
        text,
        n_agents=agents,
        theme=theme,
        minutes=minutes,
        seed=seed,
        environment=layout,
        generator=generator,
        steering=steering,
    )
    _write(world, out, with_page=page, as_json=as_json)


@click.command()
@click.argument("script", type=click.Path(path_type=Path))
@click.option("--scenario", "slug", default=None, help="Which scenario of the file; by default the first.")
@minutes_option
@seed_option
@steering_option
@out_option
@page_option
@json_option
def stage(  # noqa: PLR0913 - one parameter for each option
    script: Path,
    slug: str | None,
    minutes: float,
    seed: int,
    steering: str,
    out: Path,
    page: bool,
    as_json: bool,
) -> None:
    """Plays a scenario of SCRIPT as it is written, without a model."""
    from genc.errors import ScriptError
    from genc.files import ensure_folder
    from genc.pipeline import check_steering
    from genc.pipeline import stage as make
    from genc.scenario.corpus import load_scripts

    check_steering(steering)
    scenarios = {scenario.slug: scenario for scenario in load_scripts(script)}
    chosen = next(iter(scenarios)) if slug is None else slug
    if chosen not in scenarios:
        raise ScriptError([f"{script}: no scenario is called {chosen!r}; there are {', '.join(scenarios)}"])
    ensure_folder(out)
    world = make(scenarios[chosen], minutes=minutes, seed=seed, steering=steering)
    _write(world, out, with_page=page, as_json=as_json)


@click.command()
@click.argument("world", type=click.Path(path_type=Path))
@click.option("--agent", default=None, type=int, help="Tell of this person.")
@click.option("--group", default=None, type=int, help="Tell of this group.")
def story(world: Path, agent: int | None, group: int | None) -> None:
    """Tells what happens in WORLD (a world file, or the folder of one) in plain sentences with clock times."""
    from genc.errors import BriefError
    from genc.world.story import tell_agent, tell_group
    from genc.world.world_file import read_world

    if agent is not None and group is not None:
        raise BriefError("--agent and --group were both given: tell of one or the other")
    found = read_world(world_file(world))
    if agent is not None:
        lines = tell_agent(found, agent)
    elif group is not None:
        lines = tell_group(found, group)
    else:
        from genc.world.overview import tell_world

        lines = tell_world(found)
    click.echo("\n".join(lines))


def _write(world: World, out: Path, *, with_page: bool, as_json: bool) -> None:
    from genc.world.page import write_page
    from genc.world.world_file import write_world

    path, page = out / WORLD_FILE, out / PAGE
    write_world(world, path)
    if with_page:
        write_page(path, page)
    plan, motion = world.plan, world.motion
    summary = {
        "world": str(path),
        "page": str(page) if with_page else None,
        "agents": len(plan.people),
        "groups": len(plan.captions),
        "minutes": plan.duration_s / 60,
        "activities": len(motion.executed),
        "timeouts": sum(row.status == "timeout" for row in motion.executed),
        "notes": list(plan.notes),
        **world.provenance,
    }
    for note in plan.notes:
        click.echo(f"note: {note}", err=True)
    if as_json:
        click.echo(json_text.dumps(summary, ensure_ascii=False, indent=1))
    else:
        people, groups = _counted(len(plan.people), "person", "people"), _counted(len(plan.captions), "group", "groups")
        click.echo(f"{path}: {people} in {groups}, {plan.duration_s / 60:g} minutes")
        if with_page:
            click.echo(f"{page}: open it in a browser")
        click.echo(f"read it with 'genc story {out}'")


def _counted(n: int, one: str, many: str) -> str:
    return f"{n:,} {one if n == 1 else many}"
