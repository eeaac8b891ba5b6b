"""The client against a server that is real but small: what it gives, what it refuses, and what it never says."""

from __future__ import annotations

import logging
import subprocess
import sys
from datetime import UTC, datetime, timedelta
from email.utils import format_datetime

import pytest
from language_server import KEY, MODEL, Mishaps

from genc.errors import ExtraError, ProviderError
from genc.scenario.author.prompts import prompt
from genc.scenario.author.replies import Sentences, schema_of
from genc.words import providers
from genc.words.language import NoReply, Question
from genc.words.providers import Endpoint, OpenAIChat

QUESTION = Question(
    prompt("paraphrases", taken="(none)", sentence="In the hall people wait for a train.", count=3),
    schema_of(Sentences),
)


def told(model):
    with pytest.raises((ProviderError, NoReply)) as caught:
        model.ask(QUESTION)
    said = str(caught.value)
    assert "\n" not in said
    assert not any(KEY[i : i + 6] in said for i in range(len(KEY) - 5))
    # nothing hangs on the error either: its causes hold requests, and requests hold the key
    assert caught.value.__cause__ is None
    assert caught.value.__context__ is None or caught.value.__suppress_context__
    return caught.value


def test_a_reply_comes_with_its_tokens(serve, client):
    server = serve()
    reply = client(server.address).ask(QUESTION)
    assert reply.text.startswith('{"sentences": ["')
    assert reply.ending == "stop"
    assert (reply.usage.n_prompt, reply.usage.n_reply) == (server.books[0].n_prompt, server.books[0].n_reply)


@pytest.mark.parametrize("structured", ["schema", "json"])
def test_the_form_of_a_reply_is_asked_for(serve, structured, client):
    server = serve()
    client(server.address, structured=structured, temperature=0.5, max_reply_tokens=99).ask(QUESTION)
    (body,) = server.bodies
    form = body["response_format"]
    if structured == "schema":
        assert form["json_schema"] == {"name": "Sentences", "strict": True, "schema": schema_of(Sentences)}
    else:
        assert form == {"type": "json_object"}
        assert '"sentences"' in body["messages"][1]["content"]
    assert (body["temperature"], body["max_completion_tokens"]) == (0.5, 99)


def test_a_setting_that_is_left_open_is_not_sent(serve, client):
    server = serve()
    client(server.address).ask(QUESTION)
    assert set(server.bodies[0]) == {"model", "messages", "response_format"}


def test_a_wrong_key_is_told_without_it(serve, client, monkeypatch):
    server = serve(key="another")
    assert "refused the key (401): check the key in OPENAI_API_KEY" in str(told(client(server.address)))
    assert "put a key into NOT_SET" in str(told(client(server.address, key_env="NOT_SET")))


def test_an_unknown_model_is_told_by_name(serve, client):
    said = str(told(client(serve().address, "gpt-0")))
    assert "knows no model 'gpt-0' (404: The model `gpt-0` does not exist, says to" in said


def test_a_server_of_ones_own_wants_no_key(serve, client, monkeypatch):
    monkeypatch.delenv("OPENAI_API_KEY")
    assert client(serve(key=None).address).ask(QUESTION).text


def test_a_host_that_is_not_there(serve, client):
    failure = told(client("http://127.0.0.1:9/v1"))
    assert isinstance(failure, NoReply)
    assert failure.outcome == "unsent"


@pytest.mark.parametrize(
    ("kind", "outcome"),
    [
        ("limited", "deferred"),
        ("broken", "deferred"),
        ("slow", "lost"),
        ("cut", "lost"),
        ("no json", "lost"),
        ("hang up", "lost"),
        ("error inside", "deferred"),
    ],
)
def test_trouble_on_the_way(serve, kind, outcome, client):
    failure = told(client(serve(Mishaps(always=kind, slow_s=0.8)).address, timeout_s=0.4))
    assert isinstance(failure, NoReply)
    assert failure.outcome == outcome
    assert failure.wait_s == (0.05 if kind == "limited" else None)


@pytest.mark.parametrize(
    ("ending", "kind"),
    [
        ("refusal", "refusal"),
        ("length", "length"),
        ("stop", "empty"),
        ("stop", "no choices"),
        ("stop", "half a letter"),
    ],
)
def test_a_reply_of_no_use_is_a_reply_and_has_its_price(serve, ending, kind, client):
    server = serve(Mishaps(always=kind))
    reply = client(server.address).ask(QUESTION)
    assert reply.ending == ending
    assert reply.usage.n_prompt == server.books[0].n_prompt
    assert bool(reply.text) == (kind in ("refusal", "length", "half a letter"))


@pytest.mark.parametrize(("header", "seconds"), [("3", 3), ("0.5", 0.5), ("-1", 0), ("nan", None), ("soon", None)])
def test_retry_after_as_a_number(header, seconds):
    assert providers._wait_s({"retry-after": header}) == seconds


def test_retry_after_as_a_date():
    header = format_datetime(datetime.now(UTC) + timedelta(hours=1), usegmt=True)
    assert providers._wait_s({"retry-after": header}) == pytest.approx(3600, abs=10)


@pytest.mark.parametrize("url", ["", "nonsense", "ftp://host/v1", "http://", "http://host:port/v1", "http://ho st/v1"])
def test_a_base_url_that_is_none(url):
    with pytest.raises(ProviderError, match="the base URL is none"):
        OpenAIChat(Endpoint(MODEL, url or "x"))


@pytest.mark.parametrize("url", ["https://me:secretsecret@host/v1", "https://host/v1?key=secretsecret"])
def test_a_base_url_with_a_secret_in_it(url):
    with pytest.raises(ProviderError, match="keys belong into the environment") as caught:
        OpenAIChat(Endpoint(MODEL, url))
    assert "secretsecret" not in str(caught.value)


@pytest.mark.parametrize(
    ("key", "said"), [("", "no key"), ("two words here", "cannot be a key"), ("schlüssel", "cannot be a key")]
)
def test_a_key_that_is_none(monkeypatch, key, said):
    monkeypatch.setenv("OPENAI_API_KEY", key)
    with pytest.raises(ProviderError, match=said) as caught:
        OpenAIChat(Endpoint(MODEL))
    assert not key or key not in str(caught.value)


def test_without_the_client_the_extra_is_named(monkeypatch):
    monkeypatch.setitem(sys.modules, "openai", None)
    with pytest.raises(ExtraError, match=r"pip install 'genc\[author\]'"):
        OpenAIChat(Endpoint(MODEL, "http://localhost/v1"))


def test_no_key_in_the_logs_of_the_client(serve, caplog, client):
    caplog.set_level(logging.DEBUG)
    client(serve().address).ask(QUESTION)
    assert caplog.text
    assert KEY not in caplog.text


def test_the_commands_load_no_client_before_they_need_one():
    program = "import sys, genc.cli; print([m for m in ('openai', 'pydantic', 'sqlite3', 'numpy') if m in sys.modules])"
    assert subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True).stdout == "[]\n"
