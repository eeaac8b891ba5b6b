"""Generative crowds: one sentence in, a populated world out.

    import genc

    world = genc.populate("Around the campus park, students have lunch and wave at passing friends.", n_agents=60)
    print("\\n".join(genc.tell_group(world, 0)))
    genc.write_world(world, "park.genc")

Names are loaded when they are first used, so that `import genc` is instant.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from genc.errors import GencError as GencError
    from genc.evaluate.assessment import assess as assess
    from genc.evaluate.assessment_report import write_assessment as write_assessment
    from genc.evaluate.evaluation import Trial as Trial
    from genc.evaluate.examine import examine as examine
    from genc.evaluate.lives import read_lives as read_lives
    from genc.evaluate.material import read_material as read_material
    from genc.evaluate.report import write_report as write_report
    from genc.evaluate.sources import load_source as load_source
    from genc.graph.crowd_graph import CrowdGraph as CrowdGraph
    from genc.graph.weave import unfold as unfold
    from genc.graph.weave import weave as weave
    from genc.learn.build import build_dataset as build_dataset
    from genc.learn.dataset import load_dataset as load_dataset
    from genc.learn.run import train as train
    from genc.model.checkpoint import load_generator as load_generator
    from genc.model.source import GraphSource as GraphSource
    from genc.pipeline import populate as populate
    from genc.pipeline import stage as stage
    from genc.plan.crowd import plan_crowd as plan_crowd
    from genc.scenario.corpus import load_corpus as load_corpus
    from genc.scenario.corpus import load_scripts as load_scripts
    from genc.scenario.exchange import read_environment as read_environment
    from genc.scenario.rehearse import rehearse as rehearse
    from genc.scenario.script import write_script as write_script
    from genc.words.brief import Brief as Brief
    from genc.world.export import export_world as export_world
    from genc.world.story import tell_agent as tell_agent
    from genc.world.story import tell_group as tell_group
    from genc.world.world import World as World
    from genc.world.world_file import read_world as read_world
    from genc.world.world_file import write_world as write_world

_HOME = {
    "Brief": "words.brief",
    "CrowdGraph": "graph.crowd_graph",
    "GencError": "errors",
    "GraphSource": "model.source",
    "Trial": "evaluate.evaluation",
    "World": "world.world",
    "assess": "evaluate.assessment",
    "build_dataset": "learn.build",
    "examine": "evaluate.examine",
    "export_world": "world.export",
    "load_corpus": "scenario.corpus",
    "load_dataset": "learn.dataset",
    "load_generator": "model.checkpoint",
    "load_scripts": "scenario.corpus",
    "load_source": "evaluate.sources",
    "plan_crowd": "plan.crowd",
    "populate": "pipeline",
    "read_environment": "scenario.exchange",
    "read_lives": "evaluate.lives",
    "read_material": "evaluate.material",
    "read_world": "world.world_file",
    "rehearse": "scenario.rehearse",
    "stage": "pipeline",
    "tell_agent": "world.story",
    "tell_group": "world.story",
    "train": "learn.run",
    "unfold": "graph.weave",
    "weave": "graph.weave",
    "write_assessment": "evaluate.assessment_report",
    "write_report": "evaluate.report",
    "write_script": "scenario.script",
    "write_world": "world.world_file",
}

__all__ = sorted(_HOME)  # pyright: ignore[reportUnsupportedDunderAll]


def __getattr__(name: str) -> object:
    if name not in _HOME:
        raise AttributeError(f"module 'genc' has no attribute {name!r}")
    return getattr(import_module(f"genc.{_HOME[name]}"), name)


def __dir__() -> list[str]:
    return sorted({*globals(), *_HOME})
