"""The product: one sentence in, a populated world out.

Room: pipeline. In: a sentence. Out: a `World`. May import: every room below. Never: print, parse arguments, exit.
"""

from __future__ import annotations

from dataclasses import replace
from functools import partial

import numpy as np

from genc.errors import BriefError, LayoutError
from genc.graph.crowd_graph import CrowdGraph
from genc.graph.weave import unfold
from genc.model.checkpoint import Generator, load_generator
from genc.model.generator import CodecGenerator
from genc.motion.executor import Options, simulate
from genc.motion.jupedsim_steering import JuPedSim, library
from genc.motion.kinematic import Kinematic
from genc.motion.steering import Steering
from genc.plan.compose import compose
from genc.plan.crowd import PlanRequest, plan_crowd
from genc.plan.plan import CrowdPlan
from genc.plan.slots import places_of
from genc.plan.walkable import Walkable
from genc.scenario.corpus import load_corpus
from genc.scenario.meaning import FAMILIAR, Layout, affinity, nearest_layout
from genc.scenario.rehearse import rehearse
from genc.scenario.scenario import Environment, Scenario
from genc.words.brief import Brief
from genc.world.world import Provenance, World

MOST_AGENTS = 20_000
MOST_MINUTES = 240.0
MOST_EXTENT_M = 1000.0
"""Side of a layout: its ground is kept as a grid of small cells."""
STEERINGS = {"kinematic": Kinematic, "jupedsim": JuPedSim}
"""What moves people: shortest paths, through each other; or the collision-free speed model of the extra `jupedsim`."""
GUIDANCE = 2.0
"""One sentence has to steer a whole crowd; at 1 the groups are as various as those that were learned."""
UNFAMILIAR = (
    "the sentence is far from every sentence that was learned, so the crowd may not match it; the text encoder knows "
    "English best"
)


def populate(  # noqa: PLR0913 - the product's own door: every wish has a name and a default
    text: str,
    *,
    n_agents: int = 60,
    theme: str | None = None,
    minutes: float = 10.0,
    seed: int = 0,
    environment: Environment | None = None,
    generator: Generator | None = None,
    steering: str = "kinematic",
) -> World:
    """A world with exactly `n_agents` people who live out the sentence; the same arguments give the same world.

    Args:
        text: where it is, who is there, and what they do.
        theme: a theme of the shipped corpus; narrows the choice of a layout and colours the sentence.
        minutes: length of the world.
        environment: the layout; by default that of the authored scenario nearest in meaning.
        generator: a trained generator; by default the one that comes with the package, `steered`.
        steering: what moves the people, one of `STEERINGS`.

    Raises:
        BriefError: for an empty sentence, an unknown theme or steering, or a crowd or length out of range.
        ExtraError: for a steering that is not installed.
        LayoutError: for an environment in which nobody can be placed.
        CheckpointError, EncoderError: if the generator or its text encoder cannot be loaded.
    """
    check_request(text, n_agents, minutes)
    check_steering(steering)
    authored = load_corpus(None if theme is None else [theme])
    generator = steered(load_generator()) if generator is None else generator
    for_groups, for_plan, for_motion = np.random.default_rng(seed).spawn(3)

    asked = text if theme is None else f"{theme}: {text}"
    layout = Layout(environment) if environment else nearest_layout(asked, authored, generator.encoder)
    check_extent(layout.environment)
    groups = compose(partial(sample_groups, generator, asked, for_groups), n_agents)
    request = PlanRequest(
        duration_s=60 * minutes,
        captions=(text,) * len(groups),
        affinity=np.tile(affinity(asked, layout.environment, generator.encoder), (len(groups), 1)),
        notes=() if layout.nearness >= FAMILIAR else (f"{UNFAMILIAR} ({layout.nearness:.2f})",),
    )
    plan = plan_crowd([unfold(group) for group in groups], layout.environment, request, for_plan)
    made_with = {"theme": theme, "seed": seed, "model": generator.hash, **generator.settings}
    return play(plan, for_motion, {"text": text, **made_with}, steering)


def stage(scenario: Scenario, *, minutes: float = 10.0, seed: int = 0, steering: str = "kinematic") -> World:
    """A world in which a hand-written scenario is played as written, without a model.

    Raises:
        BriefError: for a length out of range or an unknown steering.
        ExtraError: for a steering that is not installed.
        LayoutError: for an environment in which nobody can be placed.
    """
    check_request(scenario.sentence, 1, minutes)
    check_steering(steering)
    check_extent(scenario.environment)
    for_order, for_plan, for_motion = np.random.default_rng(seed).spawn(3)
    rehearsal = rehearse(scenario, for_order)
    groups = [
        [record for record, group in zip(rehearsal.records, rehearsal.group_of, strict=True) if group == g]
        for g in range(len(rehearsal.captions))
    ]
    request = PlanRequest(duration_s=60 * minutes, captions=rehearsal.captions, triggers=rehearsal.triggers)
    plan = plan_crowd(groups, scenario.environment, request, for_plan)
    made_with: Provenance = {"text": scenario.sentence, "theme": scenario.theme, "seed": seed, "model": None}
    return play(plan, for_motion, made_with, steering)


def play(plan: CrowdPlan, rng: np.random.Generator, provenance: Provenance, steering: str = "kinematic") -> World:
    """The world in which a plan is carried out."""
    ground = Walkable.of(plan.environment)
    mover: Steering = STEERINGS[steering](len(plan.people), ground)
    motion = simulate(plan, ground, places_of(plan.environment, ground), mover, Options(), rng)
    return World(plan, motion, {**provenance, "steering": steering})


def sample_groups(
    generator: Generator, text: str, rng: np.random.Generator, n_groups: int, n_agents: int | None
) -> list[CrowdGraph]:
    """That many groups for one sentence, of `n_agents` people each if a number is given."""
    return generator.sample([Brief(text, n_agents)] * n_groups, rng)


def check_request(text: str, n_agents: int, minutes: float) -> None:
    """Raises `BriefError` for a sentence, crowd or length that no world can have."""
    Brief(text)
    if not 1 <= n_agents <= MOST_AGENTS:
        raise BriefError(f"a crowd of {n_agents} cannot be made: ask for 1 to {MOST_AGENTS} agents")
    if not 0 < minutes <= MOST_MINUTES:
        raise BriefError(f"a world of {minutes} minutes cannot be made: ask for more than 0, at most {MOST_MINUTES:g}")


def check_steering(steering: str) -> None:
    """Raises `BriefError` for an unknown steering, `ExtraError` for one that is not installed."""
    if steering not in STEERINGS:
        raise BriefError(f"there is no steering {steering!r}; choose {' or '.join(STEERINGS)}")
    if STEERINGS[steering] is JuPedSim:
        library()


def check_extent(environment: Environment) -> None:
    """Raises `LayoutError` for an environment that spreads too far to walk."""
    for axis, name in enumerate("xy"):
        edges_m = [p.position_m[axis] + side * p.size_m[axis] / 2 for p in environment.locations for side in (-1, 1)]
        extent_m = max(edges_m) - min(edges_m)
        if extent_m > MOST_EXTENT_M:
            raise LayoutError(
                f"the environment is {extent_m:g} m long in {name}; at most {MOST_EXTENT_M:g} m can be walked: check "
                "its positions and sizes"
            )


def steered(generator: Generator, guidance: float | None = None) -> Generator:
    """The generator as a crowd needs it: the text steers with `guidance`; labels are drawn where there is none.

    Raises:
        BriefError: for a guidance out of range, or one for a generator that has none.
    """
    if not isinstance(generator, CodecGenerator):
        if guidance is not None:
            raise BriefError(f"a guidance of {guidance:g} is nothing that a 'paper' model has: leave it out")
        return replace(generator, drawn=True)
    guidance = GUIDANCE if guidance is None else guidance
    if not 0 <= guidance <= 10:
        raise BriefError(f"a guidance of {guidance:g} cannot be followed: ask for 0 to 10")
    return replace(generator, guidance=guidance)
