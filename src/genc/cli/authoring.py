"""`genc author`: seeds and scenarios by a language model, and what they cost."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import closing, contextmanager
from dataclasses import asdict
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from genc.words.language import Prices, Usage

if TYPE_CHECKING:
    from genc.scenario.author.run import Manner
    from genc.words.journal import Account
    from genc.words.journalled import Journalled

JOURNAL = "journal.sqlite"

_prices = (
    click.option(
        "--price-in", default=0.0, type=click.FloatRange(0), help="Of a million tokens sent, in any currency."
    ),
    click.option("--price-out", default=0.0, type=click.FloatRange(0), help="Of a million tokens received."),
)
_of_the_model = (
    click.option("--model", required=True, help="Its name at the endpoint."),
    click.option("--base-url", help="Of the API, as http://localhost:8000/v1; else OPENAI_BASE_URL; else OpenAI's."),
    click.option("--key-env", default="OPENAI_API_KEY", show_default=True, help="Environment variable with the key."),
    click.option("--temperature", default=None, type=click.FloatRange(0, 2), help="By default the server's."),
    click.option(
        "--structured",
        default="schema",
        show_default=True,
        type=click.Choice(["schema", "json"]),
        help="How replies are kept in form: by a JSON Schema, or, where a server knows none, as JSON.",
    ),
    click.option(
        "--timeout", default=300.0, show_default=True, type=click.FloatRange(0.1), help="Seconds for a reply."
    ),
    click.option(
        "--tries", default=8, show_default=True, type=click.IntRange(1), help="Of a question without a reply."
    ),
    click.option("--parallel", default=4, show_default=True, type=click.IntRange(1, 64), help="Questions at once."),
    click.option(
        "--max-tokens-total", default=None, type=click.IntRange(1), help="Budget of this and earlier runs here."
    ),
    click.option("--max-tokens-reply", default=None, type=click.IntRange(1), help="Where a reply is cut off."),
    *_prices,
    click.option(
        "--examples",
        default=None,
        type=click.Path(path_type=Path),
        help="Scripts to show as examples; else the corpus.",
    ),
    click.option(
        "--seed", default=0, show_default=True, type=click.IntRange(0, 2**32 - 1), help="Of the choice of examples."
    ),
)


def _asking(command: Callable[..., None]) -> Callable[..., None]:
    """Gives a command the options of everything that asks a model."""
    for option in reversed(_of_the_model):
        command = option(command)
    return command


@click.group()
def author() -> None:
    """Seeds and scenarios by a language model."""


@author.command()
@click.option("--theme", required=True, help="What the sentences are about.")
@click.option("--count", default=100, show_default=True, type=click.IntRange(1, 10_000), help="Sentences.")
@click.option(
    "--paraphrases", default=50, show_default=True, type=click.IntRange(0, 1000), help="Other wordings of each."
)
@click.option("--out", required=True, type=click.Path(path_type=Path), help="Text file to write.")
@click.option("--encoder", default="minilm", show_default=True, help="Tells what is too near: minilm, mpnet, hashing.")
@click.option("--force", is_flag=True, help="Overwrite what is there.")
@_asking
def seeds(theme: str, count: int, paraphrases: int, out: Path, encoder: str, force: bool, **asked: Any) -> None:
    """Writes sentences of a theme, with other wordings of each, to a text file that you can edit.

    Every reply is kept in a journal beside it: interrupted, the same command goes on where it was.
    """
    from genc.errors import OutputError, ProviderError
    from genc.files import ensure_folder, write_text
    from genc.words.brief import Brief

    if out.exists() and not force:
        raise OutputError(f"{out} is there already; name another file or add --force")
    theme = " ".join(Brief(theme).text.split())
    ensure_folder(out.parent)
    with _model(_journal_of(out), asked) as (model, manner):
        from genc.scenario.author.run import author_seeds, spent
        from genc.scenario.author.seeds import write_seeds
        from genc.words.embed import load_encoder

        found = author_seeds(model, theme, (count, paraphrases), manner, load_encoder(encoder))
        if not found:
            raise ProviderError(f"{model.id} gave no sentence for {theme!r} that could be used: try another model")
        write_text(out, write_seeds(found))
        for short in _short(len(found), count, [len(seed.wordings) for seed in found], paraphrases):
            click.echo(f"note: {short}", err=True)
        click.echo(f"{out}: {len(found)} seeds; {spent(model.spent, manner.prices)}")


@author.command()
@click.argument("seeds_file", metavar="SEEDS", type=click.Path(path_type=Path))
@click.option("--out", required=True, type=click.Path(path_type=Path), help="Folder of the scripts and the journal.")
@click.option("--count", default=None, type=click.IntRange(1), help="The first so many seeds; else all.")
@click.option(
    "--groups", default=16, show_default=True, type=click.IntRange(1, 60), help="Groups of a scenario, about."
)
@click.option("--asks", default=4, show_default=True, type=click.IntRange(1, 20), help="Asked before it is rejected.")
@click.option("--shown", default=2, show_default=True, type=click.IntRange(0, 10), help="Examples in a question.")
@_asking
def scenarios(seeds_file: Path, out: Path, count: int | None, groups: int, asks: int, shown: int, **asked: Any) -> None:
    """Writes a scenario for each seed of SEEDS: first the layout, then what people do there.

    The scripts in the folder are ready for 'genc dataset build'. Every reply is kept in its journal: interrupted, the
    same command goes on where it was, to the same scripts.
    """
    from dataclasses import replace

    from genc.errors import OutputError, ProviderError
    from genc.files import ensure_folder
    from genc.scenario.author.seeds import read_seeds

    chosen = read_seeds(seeds_file)[:count]
    if out.resolve() in seeds_file.resolve().parents:
        raise OutputError(
            f"{out} holds the seeds, and every .txt file in it is taken for a script: name another folder"
        )
    ensure_folder(out)
    with _model(out / JOURNAL, asked) as (model, manner):
        from genc.scenario.author.events import Wish
        from genc.scenario.author.run import REJECTED, author_scenarios, spent

        manner = replace(manner, n_asks=asks, n_shown=shown)
        accepted, rejected = author_scenarios(model, chosen, out, Wish.of_groups(groups), manner)
        if not accepted:
            raise ProviderError(f"{model.id}: no reply could be used: read {out / REJECTED}, and try another model")
        said = f", {len(rejected)} rejected ({out / REJECTED})" if rejected else ""
        click.echo(f"{out}: {len(accepted)} scenarios{said}; {spent(model.spent, manner.prices)}")
        click.echo(f"next: genc dataset build {out} --out DATASET")


@author.command()
@click.argument("place", metavar="FOLDER", type=click.Path(path_type=Path))
@click.option("--each", is_flag=True, help="A line for each sentence, too.")
@click.option("--json", "as_json", is_flag=True, help="Print JSON.")
@_prices[0]
@_prices[1]
def status(place: Path, each: bool, as_json: bool, price_in: float, price_out: float) -> None:
    """How far the run in FOLDER is and what it has cost; for seeds, name their file."""
    from genc.words.journal import Journal

    path = place / JOURNAL if place.is_dir() else _journal_of(place)
    with closing(Journal(path, read_only=True)) as journal:
        notes, results = journal.notes(), journal.results()
        steps, sentences = journal.by_step(), journal.by_subject()
    given = Prices(price_in, price_out)
    prices = given if given != Prices() else Prices(float(notes.get("price_in", 0)), float(notes.get("price_out", 0)))
    total = sum((account.usage for account in steps.values()), Usage())
    states = {state: sum(found == state for _, found, _ in results) for state in ("accepted", "rejected", "open")}
    if as_json:
        figures = {
            "model": notes.get("model"),
            "scenarios": states,
            "total": {**asdict(total), "cost": prices.cost(total)},
            "steps": {name: asdict(account) for name, account in steps.items()},
            "sentences": {name: asdict(account) for name, account in sentences.items()},
        }
        click.echo(json.dumps(figures, ensure_ascii=False, indent=1))
        return
    click.echo(f"model: {notes.get('model')}")
    if results:
        click.echo("scenarios: " + ", ".join(f"{n} {state}" for state, n in states.items()))
    for line in _table(steps, prices):
        click.echo(line)
    if results and total.total:
        click.echo(f"a scenario accepted: {_per(total, states['accepted'], prices)}")
    if each:
        for name, account in sentences.items():
            click.echo(f"{account.usage.total:>10,}  {prices.cost(account.usage):>8.4f}  {name}")


@contextmanager
def _model(journal_path: Path, asked: dict[str, Any]) -> Iterator[tuple[Journalled, Manner]]:
    """The model that the options name, asked through this journal, and how a run is to work."""
    from genc.words.journal import Journal
    from genc.words.journalled import Journalled, Patience
    from genc.words.providers import Endpoint, OpenAIChat

    endpoint = Endpoint(
        model=asked["model"],
        base_url=asked["base_url"],
        key_env=asked["key_env"],
        temperature=asked["temperature"],
        max_reply_tokens=asked["max_tokens_reply"],
        structured=asked["structured"],
        timeout_s=asked["timeout"],
    )
    client = OpenAIChat(endpoint)
    # not before the client: its library brings what the replies need
    from genc.scenario.author.run import Manner
    from genc.scenario.corpus import load_corpus, load_scripts

    examples = load_corpus() if asked["examples"] is None else load_scripts(asked["examples"])
    prices = Prices(asked["price_in"], asked["price_out"])
    with closing(client), closing(Journal(journal_path)) as journal:
        journal.note({"model": client.id, "price_in": str(prices.prompt), "price_out": str(prices.reply)})
        patience = Patience(n_tries=asked["tries"], max_tokens=asked["max_tokens_total"])
        yield (
            Journalled(client, journal, patience),
            Manner(examples, asked["seed"], n_parallel=asked["parallel"], prices=prices),
        )


def _journal_of(seeds_file: Path) -> Path:
    return seeds_file.with_suffix(".journal.sqlite")


def _short(n_found: int, n_seeds: int, n_wordings: Sequence[int], n_paraphrases: int) -> Iterator[str]:
    """What there is less of than was asked for."""
    if n_found < n_seeds:
        yield f"only {n_found} of {n_seeds} sentences: the model had no others that differ enough"
    if (n_few := sum(n < n_paraphrases for n in n_wordings)) > 0:
        yield f"{n_few} sentences have fewer than {n_paraphrases} other wordings, the poorest {min(n_wordings)}"


def _table(steps: Mapping[str, Account], prices: Prices) -> Iterator[str]:
    """A line for each step and one for all; deferred calls cost nothing, lost ones may have."""
    heads = ("asked for", "replies", "deferred", "lost", "refused", "tokens in", "tokens out", "cost")
    rows = [(name, _figures(account)) for name, account in steps.items()]
    rows.append(("total", [sum(column) for column in zip(*(figures for _, figures in rows), strict=True)] or [0] * 6))
    yield f"{heads[0]:14}" + "".join(f"{head:>12}" for head in heads[1:])
    for name, figures in rows:
        cost = prices.cost(Usage(figures[4], figures[5]))
        yield f"{name:14}" + "".join(f"{figure:>12,}" for figure in figures) + f"{cost:>12.4f}"


def _figures(account: Account) -> list[int]:
    return [
        account.n_answered,
        account.n_deferred,
        account.n_lost,
        account.n_refused,
        account.usage.n_prompt,
        account.usage.n_reply,
    ]


def _per(total: Usage, n: int, prices: Prices) -> str:
    return f"{total.total / n:,.0f} tokens, cost {prices.cost(total) / n:,.4f}" if n else "none yet"
