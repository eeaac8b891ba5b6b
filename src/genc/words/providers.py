"""A model behind any OpenAI-compatible endpoint. The only module that talks to a network.

The key is read from the environment, goes into the client and nowhere else. Texts of the client and of the server are
not passed on as they are: what is quoted goes through `_without`.
"""

from __future__ import annotations

import json
import math
import os
import time
from dataclasses import dataclass
from email.utils import parsedate_to_datetime
from types import ModuleType
from typing import Any, Literal
from urllib.parse import urlsplit

from genc.errors import ExtraError, ProviderError
from genc.words.language import CHARACTERS_A_TOKEN, NoReply, Question, Reply, Turn, Usage

STRUCTURED = ("schema", "json")
CONNECT_S = 10.0
_DEFERRED = {408, 409, 425, 429}
_NO_KEY = "none"
"""What is sent where no key is asked for; the client wants one."""


@dataclass(frozen=True)
class Endpoint:
    """Where a model is found and how it is asked.

    Attributes:
        model: its name there.
        base_url: of the API, ending in `/v1` as a rule; by default that of OpenAI.
        key_env: the environment variable that holds the key; a server of one's own may want none.
        temperature: by default the server's.
        max_reply_tokens: where a reply is cut off; by default where the server does.
        structured: `schema` has the server hold the reply to a JSON Schema; `json` only to JSON, for servers that know
            no schemas: it is told the schema in words.
        timeout_s: how long a reply may take.
    """

    model: str
    base_url: str | None = None
    key_env: str = "OPENAI_API_KEY"
    temperature: float | None = None
    max_reply_tokens: int | None = None
    structured: Literal["schema", "json"] = "schema"
    timeout_s: float = 300.0

    @property
    def id(self) -> str:
        """The model and all that changes what it says; not where it is served."""
        said = {"temperature": self.temperature, "max": self.max_reply_tokens, "structured": self.structured}
        return " ".join([self.model, *(f"{name}={value}" for name, value in said.items() if value is not None)])


class OpenAIChat:
    """A `LanguageModel` that is asked over HTTP, one try a question, without the client's own retries.

    Who asks keeps the accounts (`words.journalled`), so every try has to pass through its hands.

    Raises:
        ExtraError: if the client is not installed.
        ProviderError: for a base URL or key that cannot be used.
    """

    def __init__(self, endpoint: Endpoint) -> None:
        self._openai = library()
        self._endpoint = endpoint
        self.id = endpoint.id
        self._host = _checked_host(endpoint.base_url)
        self._key = _checked_key(endpoint)
        self._client = self._openai.OpenAI(
            api_key=self._key or _NO_KEY,
            base_url=endpoint.base_url,
            timeout=self._openai.Timeout(endpoint.timeout_s, connect=min(CONNECT_S, endpoint.timeout_s)),
            max_retries=0,
        )

    def close(self) -> None:
        """Hangs up."""
        self._client.close()

    def ask(self, question: Question) -> Reply:
        """The model's reply, in one try.

        Raises:
            NoReply: if none came, and trying again makes sense.
            ProviderError: if none will come.
        """
        openai = self._openai
        try:
            answer = self._client.chat.completions.create(**self._request(question))
        except openai.APIStatusError as error:
            raise self._refusal(error) from None
        except openai.APIConnectionError as error:
            raise self._silence(error) from None
        except (openai.OpenAIError, ValueError):
            raise NoReply("lost", f"{self._host} sent a reply that is cut off or no JSON") from None
        if not isinstance(answer, openai.types.chat.ChatCompletion):
            raise ProviderError(
                f"{self._host} does not answer like an OpenAI-compatible server: check --base-url; it often ends in /v1"
            )
        if getattr(answer, "error", None):
            raise NoReply("deferred", f"{self._host} answered with an error in place of a reply")
        return self._reply(question, answer)

    def _request(self, question: Question) -> dict[str, Any]:
        turns, form = list(question.turns), {"type": "json_object"}
        if self._endpoint.structured == "schema":
            named = {"name": question.schema["title"], "strict": True, "schema": question.schema}
            form = {"type": "json_schema", "json_schema": named}  # type: ignore[dict-item]
        else:
            turns.insert(
                1, Turn("system", f"Reply with one JSON object of this JSON Schema:\n{json.dumps(question.schema)}")
            )
        wishes = {
            "temperature": self._endpoint.temperature,
            "max_completion_tokens": self._endpoint.max_reply_tokens,
        }
        return {
            "model": self._endpoint.model,
            "messages": [{"role": turn.role, "content": turn.text} for turn in turns],
            "response_format": form,
            **{name: value for name, value in wishes.items() if value is not None},
        }

    def _reply(self, question: Question, answer: Any) -> Reply:
        choice = next(iter(answer.choices or ()), None)
        message = choice.message if choice else None
        refusal = getattr(message, "refusal", None)
        # JSON can spell half of a surrogate pair, which no file can hold
        text = (refusal or getattr(message, "content", None) or "").encode("utf-8", "replace").decode("utf-8")
        ending = "refusal" if refusal else getattr(choice, "finish_reason", None) or "stop"
        usage = answer.usage
        n_prompt = _count(getattr(usage, "prompt_tokens", None), question.n_tokens_about)
        n_reply = _count(getattr(usage, "completion_tokens", None), len(text) // CHARACTERS_A_TOKEN)
        return Reply(text.replace(self._key, "[key]") if self._key else text, Usage(n_prompt, n_reply), ending)

    def _refusal(self, error: Any) -> NoReply | ProviderError:
        """What an answer with a bad status means."""
        status, host, model = error.status_code, self._host, self._endpoint.model
        said = _without(self._key, _words_of(error.body))
        if error.code == "insufficient_quota":
            return ProviderError(
                f"{host}: the account behind the key has no credit left ({status}): top it up, then go on"
            )
        if status in _DEFERRED or status >= 500:
            return NoReply("deferred", f"{host} answered {status}", _wait_s(error.response.headers))
        if status in (401, 403):
            env = self._endpoint.key_env
            how = f"check the key in {env}" if self._key else f"put a key into {env}"
            return ProviderError(f"{host} refused the key ({status}): {how}")
        if status == 404:
            return ProviderError(f"{host} knows no model {model!r} (404{said}): check --model and --base-url")
        hint = "; a server that knows no JSON Schema wants --structured json" if status in (400, 422) else ""
        return ProviderError(f"{host} refused the request ({status}{said}): check --model and the options{hint}")

    def _silence(self, error: Exception) -> NoReply:
        """What no answer at all means."""
        cause = type(error.__cause__).__name__
        if cause in ("ConnectError", "ConnectTimeout", "UnsupportedProtocol", "LocalProtocolError"):
            return NoReply("unsent", f"{self._host} cannot be reached")
        if isinstance(error, self._openai.APITimeoutError):
            return NoReply("lost", f"{self._host} did not answer within {self._endpoint.timeout_s:g} s")
        return NoReply("lost", f"{self._host} broke off its answer")


def library() -> ModuleType:
    """The client library.

    Raises:
        ExtraError: if it is not installed.
    """
    try:
        import openai
    except ImportError:
        raise ExtraError("asking a language model", "author") from None
    return openai


def _checked_host(base_url: str | None) -> str:
    """The part of a base URL that may be shown."""
    if base_url is None:
        base_url = os.environ.get("OPENAI_BASE_URL") or "https://api.openai.com/v1"
    try:
        parts = urlsplit(base_url)
        port = parts.port
    except ValueError:
        parts, port = urlsplit(""), None
    if parts.scheme not in ("http", "https") or not parts.hostname or set(base_url) & set(" \t\r\n"):
        raise ProviderError("the base URL is none: write --base-url https://host/v1")
    if parts.username or parts.password or parts.query:
        raise ProviderError(
            "the base URL holds a name, password or query: keys belong into the environment (--key-env)"
        )
    return parts.hostname + (f":{port}" if port else "")


def _checked_key(endpoint: Endpoint) -> str:
    key = os.environ.get(endpoint.key_env, "").strip()
    if not (key.isascii() and key.isprintable()) or " " in key:
        raise ProviderError(
            f"what {endpoint.key_env} holds cannot be a key: it has spaces or odd characters; set it anew"
        )
    if not key and _checked_host(endpoint.base_url) == "api.openai.com":
        raise ProviderError(
            f"no key: put it into the environment variable {endpoint.key_env}, or name one with --key-env"
        )
    return key


def _words_of(body: object) -> str:
    """The server's own words about a refusal."""
    message = body.get("message") if isinstance(body, dict) else None
    return message if isinstance(message, str) else ""


def _without(key: str, text: str) -> str:
    """The text as `: text`, short, on one line, without any word that shares six characters in a row with the key."""
    pieces = {key[i : i + 6] for i in range(max(len(key) - 5, 1))} if key else set()
    words = [word for word in text.split() if not any(piece in word for piece in pieces)]
    said = " ".join(words)
    return f": {said if len(said) <= 160 else said[:157] + '...'}" if said else ""


def _wait_s(headers: Any) -> float | None:
    """The seconds of a `Retry-After`, which may be a number or a date."""
    for name, divisor in (("retry-after-ms", 1000.0), ("retry-after", 1.0)):
        try:
            seconds = float(headers.get(name)) / divisor
        except (TypeError, ValueError):
            continue
        return max(0.0, seconds) if math.isfinite(seconds) else None
    try:
        return max(0.0, parsedate_to_datetime(headers.get("retry-after")).timestamp() - time.time())
    except (TypeError, ValueError, OverflowError):
        return None


def _count(value: object, otherwise: int) -> int:
    """A number of tokens; where a server counts none, about as many as there are characters for."""
    return value if isinstance(value, int) and not isinstance(value, bool) and value >= 0 else otherwise
