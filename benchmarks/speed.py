"""How fast: groups per second as arrays, whether all of them hold, and `genc populate` from a cold start.

    python benchmarks/speed.py --dataset out/dataset --threads 2

`README.md` beside this file says what the numbers mean.
"""

from __future__ import annotations

import argparse
import math
import platform
import subprocess
import sys
import tempfile
import time
from itertools import cycle, islice
from pathlib import Path

import numpy as np
import torch

from genc.errors import GencError
from genc.evaluate.adherence import adherence
from genc.graph.codec import Tokens, decode, group_fault
from genc.graph.crowd_graph import CrowdGraph
from genc.graph.describe import full_brief
from genc.learn.dataset import Sample, load_dataset
from genc.model.checkpoint import SHIPPED, load_generator
from genc.model.generator import CodecGenerator
from genc.words.brief import Brief

SENTENCE = "On market day in the old square, people queue for bread, meet friends and listen to a street musician"
WARM_UP = 512


def sampling(generator: CodecGenerator, briefs: list[Brief], rng: np.random.Generator) -> tuple[list[Tokens], float]:
    """One group for each brief, and the seconds it took to draw them as arrays with their texts embedded before."""
    given = generator.conditions(briefs)
    generator.sample_batch(given[torch.arange(min(WARM_UP, len(briefs)))], rng)
    start = time.perf_counter()
    batch = generator.sample_batch(given, rng)
    drawn_s = time.perf_counter() - start
    return batch.tokens(), drawn_s


def report(title: str, briefs: list[Brief], tokens: list[Tokens], drawn_s: float) -> str:
    """One line: speed, and the shares that are valid and exact."""
    held = [(brief, group) for brief, t in zip(briefs, tokens, strict=True) if (group := _valid(t)) is not None]
    kept = adherence([brief for brief, _ in held], [group for _, group in held])
    exact = {"agents": kept.agents, "events": kept.events, "nodes": kept.nodes}
    asked = [f"{what} exact {100 * share:.2f} %" for what, share in exact.items() if not math.isnan(share)]
    found = [f"{len(tokens) / drawn_s:,.0f} groups/s", f"{len(held):,} of {len(tokens):,} valid", *asked]
    return f"{title}: " + ", ".join(found)


def populate(n_agents: int) -> float:
    """The seconds that `genc populate` takes from the shell's prompt to the files."""
    genc = Path(sys.executable).with_name("genc")
    with tempfile.TemporaryDirectory() as folder:
        start = time.perf_counter()
        subprocess.run(
            [genc, "populate", SENTENCE, "--agents", str(n_agents), "--out", Path(folder) / "world"],
            check=True,
            stdout=subprocess.DEVNULL,
        )
        return time.perf_counter() - start


def _valid(tokens: Tokens) -> CrowdGraph | None:
    """The group that tokens spell, if they spell one that would pass as authored."""
    try:
        group = decode(tokens)
    except ValueError:
        return None
    return group if group_fault(group) is None else None


def _like(samples: list[Sample], n: int) -> list[Sample]:
    """`n` samples: these over and over."""
    return list(islice(cycle(samples), n))


def _arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--model", type=Path, default=SHIPPED, help="a folder that 'genc train' made (the shipped one)")
    parser.add_argument("--dataset", type=Path, required=True, help="a folder made by 'genc dataset build'")
    parser.add_argument("--groups", type=int, default=20_000, help="how many to sample for each way of asking")
    parser.add_argument("--agents", type=int, nargs="*", default=[60, 2000], help="crowds to populate; none to skip")
    parser.add_argument("--threads", type=int, default=2)
    parser.add_argument("--seed", type=int, default=0)
    return parser.parse_args()


def main() -> None:
    args = _arguments()
    torch.set_num_threads(args.threads)
    print(f"{platform.machine()}, {args.threads} threads, torch {torch.__version__}")
    generator = load_generator(args.model)
    samples = _like(load_dataset(args.dataset).split("test"), args.groups)
    ways = {
        "full condition": [full_brief(s.sentence, s.graph) for s in samples],
        "sentence alone": [Brief(s.sentence) for s in samples],
    }
    for title, briefs in ways.items():
        print(report(title, briefs, *sampling(generator, briefs, np.random.default_rng(args.seed))))
    for n_agents in args.agents:
        print(f"genc populate --agents {n_agents}: {populate(n_agents):.1f} s")


if __name__ == "__main__":
    try:
        main()
    except GencError as error:
        sys.exit(f"error: {error}")
