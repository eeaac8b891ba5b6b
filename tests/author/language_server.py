"""A small server that speaks the chat completions of the OpenAI API, answers from the authored corpus, and misbehaves.

What it says is a function of the request alone. Whether it misbehaves is drawn from a seed, for spoilt replies by the
request, for trouble on the way also by how often that request came. It keeps books of its own.

    python tests/author/language_server.py --rate 0.05 --seed 1     # prints its base URL; GET /books
"""

from __future__ import annotations

import argparse
import hashlib
import json
import random
import re
import select
import socket
import threading
import time
from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import asdict, dataclass
from functools import cache
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from typing import Any

from genc.scenario.corpus import load_corpus
from genc.scenario.exchange import write_json
from genc.scenario.scenario import Scenario

KEY = "sk-proj-Yp7GuTb42QmZr93KfWd8"
MODEL = "authored-1"
SPOILT = (
    "invalid json",
    "wrong schema",
    "length",
    "empty",
    "refusal",
    "unknown location",
    "echo",
    "no choices",
    "half a letter",
)
TROUBLE = ("limited", "broken", "slow", "cut", "no json", "hang up", "error inside")
_OPENERS = (
    "Picture this scene:",
    "Seen from a balcony:",
    "As on any such day,",
    "A short report:",
    "What a passer-by sees:",
    "From the diary of the place:",
    "Told to a child:",
    "In plain words:",
    "Noted at this hour:",
    "A view from above:",
)
_CLOSERS = (
    "",
    "and so it goes on for a while.",
    "and nobody is in a hurry.",
    "with much coming and going.",
    "just as one would expect there.",
    "while the clock moves on.",
    "under a changing light.",
)


@dataclass(frozen=True)
class Mishaps:
    """How often what goes wrong: the share of replies for each kind."""

    rate: float = 0.0
    kinds: tuple[str, ...] = (*SPOILT, *TROUBLE)
    seed: int = 0
    slow_s: float = 3.0
    delay_s: float = 0.0
    retry_after: str = "0.05"
    always: str | None = None

    def drawn(self, among: Sequence[str], *what: object) -> str | None:
        """What goes wrong now, if anything."""
        if self.always in among:
            return self.always
        kinds = [kind for kind in among if kind in self.kinds]
        chance = random.Random(repr((self.seed, *what))).random()
        at = int(chance / self.rate) if self.rate else len(kinds)
        return kinds[at] if at < len(kinds) else None


@dataclass
class Entry:
    """One request in the books."""

    question: str
    status: int
    fault: str | None
    delivered: bool
    n_prompt: int = 0
    n_reply: int = 0


class LanguageServer(ThreadingHTTPServer):
    """The server; `books` has an entry for each request that reached the model, `address` is its base URL."""

    daemon_threads = True
    request_queue_size = 128

    def __init__(self, mishaps: Mishaps = Mishaps(), key: str | None = KEY, port: int = 0) -> None:
        super().__init__(("127.0.0.1", port), _Handler)
        self.mishaps, self.key = mishaps, key
        self.books: list[Entry] = []
        self.bodies: list[dict[str, Any]] = []
        self.gate = threading.Lock()
        self.asked: Counter[str] = Counter()
        self.author = _author()
        self.address = f"http://127.0.0.1:{self.server_port}/v1"

    def __enter__(self) -> LanguageServer:
        threading.Thread(target=self.serve_forever, args=(0.02,), daemon=True).start()
        return self

    def __exit__(self, *_: object) -> None:
        self.shutdown()
        self.server_close()

    def handle_error(self, *_: object) -> None:
        """A client that is gone is nothing to talk about."""


class _Handler(BaseHTTPRequestHandler):
    protocol_version = "HTTP/1.1"
    server: LanguageServer

    def log_message(self, *_: object) -> None:
        pass

    def do_GET(self) -> None:
        if self.path == "/books":
            with self.server.gate:
                self._send(200, json.dumps([asdict(entry) for entry in self.server.books]).encode())
        else:
            self._fail(404, "no such page")

    def do_POST(self) -> None:
        body = self.rfile.read(int(self.headers["Content-Length"]))
        given = self.headers.get("Authorization", "").removeprefix("Bearer ")
        if self.server.key is not None and given != self.server.key:
            self._fail(401, f"Incorrect API key provided: {given}. You can find your API key on our page.")
        elif self.path != "/v1/chat/completions":
            self._fail(404, f"nothing at {self.path}")
        elif (asked := json.loads(body))["model"] != MODEL:
            self._fail(404, f"The model `{asked['model']}` does not exist, says {given} to {given[:12]}")
        else:
            self._answer(asked, hashlib.sha256(body).hexdigest())

    def _answer(self, asked: dict[str, Any], question: str) -> None:
        server, mishaps = self.server, self.server.mishaps
        with server.gate:
            server.asked[question] += 1
            trouble = mishaps.drawn(TROUBLE, question, server.asked[question])
            spoilt = mishaps.drawn(SPOILT, question)
            entry = Entry(question, 200, trouble or spoilt, False)
            server.books.append(entry)
            server.bodies.append(asked)
        time.sleep(mishaps.delay_s)
        if trouble in ("limited", "broken"):
            entry.status = 429 if trouble == "limited" else 500
            self._fail(
                entry.status, f"not now, {KEY}", {"Retry-After": mishaps.retry_after} if trouble == "limited" else {}
            )
            return
        if trouble == "error inside":
            entry.status = 502
            self._send(
                200, json.dumps({"error": {"message": f"the model behind is down, {KEY}", "code": 502}}).encode()
            )
            return
        completion = completed(asked, self.server.author.reply(asked), spoilt)
        entry.n_prompt, entry.n_reply = completion["usage"]["prompt_tokens"], completion["usage"]["completion_tokens"]
        sent = json.dumps(completion).encode()
        if trouble == "slow":
            time.sleep(mishaps.slow_s)
        if trouble == "hang up" or self._client_is_gone():
            self.close_connection = True
        elif trouble == "no json":
            self._send(200, sent[: len(sent) // 2])
        else:
            self._send(200, sent, cut=trouble == "cut")
            entry.delivered = trouble is None

    def _client_is_gone(self) -> bool:
        ready, _, _ = select.select([self.connection], [], [], 0)
        return bool(ready) and self.connection.recv(1, socket.MSG_PEEK) == b""

    def _fail(self, status: int, message: str, headers: dict[str, str] | None = None) -> None:
        self._send(status, json.dumps({"error": {"message": message, "code": None}}).encode(), headers or {})

    def _send(self, status: int, content: bytes, headers: dict[str, str] | None = None, *, cut: bool = False) -> None:
        self.send_response(status)
        self.send_header("Content-Type", "application/json")
        self.send_header("Content-Length", str(len(content)))
        for name, value in (headers or {}).items():
            self.send_header(name, value)
        self.end_headers()
        self.wfile.write(content[: len(content) // 2] if cut else content)
        self.close_connection = cut


def completed(asked: dict[str, Any], reply: dict[str, Any], spoilt: str | None) -> dict[str, Any]:
    """The completion with a reply, spoilt or not, and its tokens."""
    text: str | None = json.dumps(reply, ensure_ascii=False)
    prompt = "\n".join(turn["content"] for turn in asked["messages"])
    message: dict[str, Any] = {"role": "assistant", "refusal": None}
    if spoilt == "wrong schema":
        text = json.dumps([reply, {"locations": {}, "groups": 3, "sentences": "none"}])
    elif spoilt == "unknown location":
        text = text.replace('"location": "', '"location": "the far side of ').replace('"entrance"', '"portal"')
    elif spoilt in ("invalid json", "length"):
        text = text[: 2 * len(text) // 3]
    elif spoilt == "half a letter":
        text += "\ud83d"
    elif spoilt == "echo":
        text = prompt
    elif spoilt == "empty":
        text = ""
    elif spoilt == "refusal":
        text, message["refusal"] = None, "I cannot help with that."
    message["content"] = text
    ending = "length" if spoilt == "length" else "stop"
    usage = {"prompt_tokens": len(prompt) // 4, "completion_tokens": len(text or "") // 4, "total_tokens": 0}
    choices = [] if spoilt == "no choices" else [{"index": 0, "message": message, "finish_reason": ending}]
    head = {"id": "chatcmpl-1", "object": "chat.completion", "created": 0, "model": MODEL}
    return {**head, "choices": choices, "usage": usage}


class Author:
    """What a language model would say, from the authored corpus."""

    def __init__(self) -> None:
        self.corpus = [scenario for scenario in load_corpus() if not _books_twice(scenario)]
        self.documents = [json.loads(write_json([scenario]))["scenarios"][0] for scenario in self.corpus]
        self.by_names = {" | ".join(p["name"] for p in doc["locations"]): doc for doc in self.documents}

    def reply(self, asked: dict[str, Any]) -> dict[str, Any]:
        """The reply to a request."""
        text = next(turn["content"] for turn in asked["messages"] if turn["role"] == "user")
        form = asked["response_format"]
        rules = "".join(turn["content"] for turn in asked["messages"] if turn["role"] == "system")
        name = (
            form["json_schema"]["name"] if "json_schema" in form else re.findall(r'"title": "(\w+)", "type"', rules)[-1]
        )
        if name == "Layout":
            return {"locations": self._layout(text)}
        if name == "Happenings":
            return {"groups": self._groups(text, rules)}
        theme, sentence = re.search(r"^Theme: (.*)$", text, re.M), re.search(r"^Sentence: (.*)$", text, re.M)
        n = int(re.findall(r"^Write (\d+) ", text, re.M)[-1])
        drawn = self._seeds(theme[1], text) if theme else self._wordings(sentence[1])  # type: ignore[index]
        new = (said for said in drawn if said not in text)
        return {"sentences": [said for said, _ in zip(new, range(n), strict=False)]}

    def _seeds(self, theme: str, text: str) -> Iterator[str]:
        taken = re.findall(rf"^At the {re.escape(theme)}, .*$", text, re.M)
        yield from (f"{said.rstrip('.')}!!" for said in taken[:1])
        for scenario in random.Random(theme).sample(self.corpus, len(self.corpus)):
            _, comma, rest = scenario.sentence.partition(", ")
            yield f"At the {theme.lower()}, {rest if comma and len(rest.split()) > 12 else scenario.sentence}"

    @staticmethod
    def _wordings(sentence: str) -> Iterator[str]:
        said = sentence.rstrip(".")
        yield from (
            " ".join([opener, said[0].lower() + said[1:], closer]) for closer in _CLOSERS for opener in _OPENERS
        )

    def _layout(self, text: str) -> list[dict[str, Any]]:
        sentence = re.findall(r"^Sentence: (.*)$", text, re.M)[-1]
        order = random.Random(sentence).sample(range(len(self.corpus)), len(self.corpus))
        return next(self.documents[i]["locations"] for i in order if self.corpus[i].sentence not in text)

    def _groups(self, text: str, rules: str) -> list[dict[str, Any]]:
        groups = self.by_names[re.findall(r"^Locations: (.*)$", text, re.M)[-1]]["groups"]
        wanted = re.search(r"exactly (\d+) people", rules)
        return groups if wanted is None else list(_crowd(groups, int(wanted[1])))


def _books_twice(scenario: Scenario) -> bool:
    """Whether somebody has to be in two events that begin together: a few of the authored ones do."""
    begun = ((g, a, e.after) for g, group in enumerate(scenario.groups) for e in group.events for a in e.agents)
    return max(Counter(begun).values()) > 1


@cache
def _author() -> Author:
    return Author()


def _crowd(groups: Sequence[dict[str, Any]], n_agents: int) -> Iterator[dict[str, Any]]:
    """Groups over and over, numbered anew, until so many people are there."""
    n, first = 0, 1
    while n < n_agents:
        for group in groups:
            number = {event["id"]: first + i for i, event in enumerate(group["events"])}
            size = len({agent for event in group["events"] for agent in event["agents"]})
            if n < n_agents and all(event["after"] in {None, *number} for event in group["events"]):
                new = [{**e, "id": number[e["id"]], "after": number.get(e["after"])} for e in group["events"]]
                yield {"caption": group["caption"], "events": new}
                n, first = n + size, first + len(number)


def accounts(books: Sequence[Entry]) -> dict[str, int]:
    """The sums of the books."""
    delivered = [entry for entry in books if entry.delivered]
    return {
        "delivered": len(delivered),
        "deferred": sum(entry.status != 200 for entry in books),
        "lost": sum(entry.status == 200 and not entry.delivered for entry in books),
        "n_prompt": sum(entry.n_prompt for entry in delivered),
        "n_reply": sum(entry.n_reply for entry in delivered),
    }


def main() -> None:
    """Serves until it is killed."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--port", type=int, default=0)
    parser.add_argument("--rate", type=float, default=0.0)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--slow-s", type=float, default=3.0)
    parser.add_argument("--delay-s", type=float, default=0.0)
    parser.add_argument("--spoilt-only", action="store_true", help="replies are bad, but all arrive")
    parser.add_argument("--key", default=KEY)
    asked = parser.parse_args()
    kinds = SPOILT if asked.spoilt_only else (*SPOILT, *TROUBLE)
    mishaps = Mishaps(asked.rate, kinds, seed=asked.seed, slow_s=asked.slow_s, delay_s=asked.delay_s)
    server = LanguageServer(mishaps, asked.key, asked.port)
    print(server.address, flush=True)
    server.serve_forever()


if __name__ == "__main__":
    main()
