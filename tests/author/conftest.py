"""A server to ask, its key in the environment, and the command line."""

from __future__ import annotations

from pathlib import Path

import pytest
from language_server import KEY, MODEL, LanguageServer, Mishaps

from genc.scenario.author.seeds import Seed, write_seeds
from genc.scenario.corpus import load_corpus, load_theme, themes
from genc.scenario.script import write_script
from genc.words.journal import Journal
from genc.words.journalled import Journalled, Patience
from genc.words.providers import Endpoint, OpenAIChat

THEME = "Ski resort"


@pytest.fixture(autouse=True)
def environment(monkeypatch):
    monkeypatch.setenv("OPENAI_API_KEY", KEY)
    monkeypatch.setenv("NO_PROXY", "127.0.0.1")
    monkeypatch.delenv("OPENAI_BASE_URL", raising=False)


@pytest.fixture
def serve():
    """Starts servers; they end with the test."""
    servers: list[LanguageServer] = []

    def start(mishaps: Mishaps | None = None, key: str | None = KEY) -> LanguageServer:
        servers.append(LanguageServer(mishaps or Mishaps(), key).__enter__())
        return servers[-1]

    yield start
    for server in servers:
        server.__exit__()


@pytest.fixture
def client():
    """Clients; they hang up with the test."""
    clients: list[OpenAIChat] = []

    def connect(address: str | None, model: str = MODEL, **more: object) -> OpenAIChat:
        clients.append(OpenAIChat(Endpoint(model, address, **more)))  # type: ignore[arg-type]
        return clients[-1]

    yield connect
    for one in clients:
        one.close()


@pytest.fixture
def ask(tmp_path, client):
    """Models asked through journals; closed with the test."""
    journals: list[Journal] = []

    def connect(server: LanguageServer, name: str = "journal.sqlite", patience: Patience | None = None, **more: object):
        journals.append(Journal(tmp_path / name))
        return Journalled(
            client(server.address, **more), journals[-1], patience or Patience(first_wait_s=0.01, longest_wait_s=0.1)
        )

    yield connect
    for journal in journals:
        journal.close()


@pytest.fixture(scope="session")
def examples():
    """Authored scenarios to show: one of each theme."""
    return [load_theme(theme)[0] for theme in themes()[:3]]


@pytest.fixture(scope="session")
def examples_file(examples, tmp_path_factory) -> Path:
    path = tmp_path_factory.mktemp("examples") / "few.txt"
    path.write_text(write_script(examples), encoding="utf-8")
    return path


@pytest.fixture(scope="session")
def many_seeds():
    """Seeds of a theme that nobody authored."""
    tails = [scenario.sentence.partition(", ")[2] or scenario.sentence for scenario in load_corpus()]
    return [Seed(THEME, f"At the ski resort, {tail}", (f"Snow: {tail}",)) for tail in tails]


@pytest.fixture
def seeds_file(many_seeds, tmp_path):
    """Writes so many of them."""

    def write(n: int) -> Path:
        path = tmp_path / "seeds" / "ski.txt"
        path.parent.mkdir(exist_ok=True)
        path.write_text(write_seeds(many_seeds[:n]), encoding="utf-8")
        return path

    return write
