"""The three files of a report say the same, and each can be read by itself."""

from __future__ import annotations

import json
import re
import xml.etree.ElementTree as ET
from html.parser import HTMLParser
from pathlib import Path

import museum
import pytest

from genc.errors import ExtraError, OutputError
from genc.evaluate import provenance
from genc.evaluate.baselines import Shuffle
from genc.evaluate.evaluation import Evaluation, Trial
from genc.evaluate.examine import examine
from genc.evaluate.report import write_report

NOTE = "Mind the <bones> & gaps."
DIGITS = {"nats": 4, "%": 1, "sd²": 1, "groups/s": 0, "": 4}
COLUMNS = {"test groups": "authored", "floor": "floor", "generated": "generated", "as decoded": "decoded"}
VOID = {"meta", "br", "hr", "img", "link", "input"}


class Page(HTMLParser):
    """The cells of all tables, and whether every tag is closed."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.open: list[str] = []
        self.rows: list[list[str]] = []
        self.feed(text)

    def handle_starttag(self, tag: str, attrs: object) -> None:
        if tag == "tr":
            self.rows.append([])
        if tag in ("td", "th"):
            self.rows[-1].append("")
        if tag not in VOID:
            self.open.append(tag)

    def handle_endtag(self, tag: str) -> None:
        assert self.open.pop() == tag

    def handle_data(self, data: str) -> None:
        if "td" in self.open or "th" in self.open:
            self.rows[-1][-1] += data


@pytest.fixture(scope="module")
def evaluation() -> Evaluation:
    material = museum.material(NOTE)
    return examine(Shuffle([s.graph for s in material.train]), material, Trial(n_repeats=2), "shuffle")


@pytest.fixture(scope="module")
def folder(evaluation: Evaluation, tmp_path_factory: pytest.TempPathFactory) -> Path:
    place = tmp_path_factory.mktemp("report") / "new"
    assert write_report(evaluation, place) == place / "report.html"
    return place


def rows_of(markdown: str) -> list[list[str]]:
    lines = [line for line in markdown.splitlines() if line.startswith("|") and not line.startswith("|---")]
    return [[cell.strip() for cell in line.strip("|").split("|")] for line in lines]


def test_the_json_is_the_evaluation(evaluation: Evaluation, folder: Path) -> None:
    said = json.loads((folder / "result.json").read_text(encoding="utf-8"))
    assert said == json.loads(json.dumps(evaluation.as_json()))
    assert {"model", "seed", "n_repeats", "dataset_hash", "versions", "processor", "platform"} <= set(said["facts"])
    total = next(figure for figure in said["figures"] if figure["name"] == "total")
    assert total["ratio"] == pytest.approx(total["generated"]["mean"] / total["floor"]["mean"])


def test_every_number_of_the_tables_is_that_of_the_json(folder: Path) -> None:
    figures = {f["name"]: f for f in json.loads((folder / "result.json").read_text(encoding="utf-8"))["figures"]}
    seen = set()
    heads: list[str] = []
    for row in rows_of((folder / "report.md").read_text(encoding="utf-8")):
        name = re.sub(r" \([^)]*\)$", "", row[0])
        if name not in figures:
            heads = row
            continue
        seen.add(name)
        figure = figures[name]
        for head, cell in zip(heads[1:], row[1:], strict=True):
            if head in COLUMNS and cell:
                numbers = [f"{v:,.{DIGITS[figure['unit']]}f}" for v in figure[COLUMNS[head]].values()]
                assert re.findall(r"-?[\d,.]+", cell) in (numbers, numbers[:1]), (name, head)
            if head == "× floor" and cell:
                assert cell == f"{figure['ratio']:.2f}"
    assert seen == set(figures)


def test_page_and_markdown_hold_the_same_tables(folder: Path) -> None:
    page = Page((folder / "report.html").read_text(encoding="utf-8"))
    assert page.open == []
    written = [[re.sub(r"[()]", "", cell) for cell in row] for row in rows_of((folder / "report.md").read_text())]
    shown = [[re.sub(r"[()]", "", cell) for cell in row] for row in page.rows]
    assert [row for row in shown if any(row)] == [row for row in written if any(row)]


def test_the_page_stands_alone_and_its_pictures_are_sound(folder: Path) -> None:
    text = (folder / "report.html").read_text(encoding="utf-8")
    pictures = re.findall(r"<svg.*?</svg>", text, re.DOTALL)
    assert len(pictures) == 3
    said = ["".join(ET.fromstring(picture).itertext()) for picture in pictures]
    assert all(word in said[0] for word in ("talk on phone", "service area", "generated"))
    assert "average path length" in said[1]
    bare = re.sub(r"<svg.*?</svg>", "", text, flags=re.DOTALL)
    assert not re.search(r"https?:|<script|<link|src=", bare)
    assert not re.search(r'href="(?!#|data:)', text)
    assert "Mind the &lt;bones&gt; &amp; gaps." in text


def test_the_same_evaluation_gives_the_same_bytes(evaluation: Evaluation, folder: Path, tmp_path: Path) -> None:
    write_report(evaluation, tmp_path)
    for file in folder.iterdir():
        assert (tmp_path / file.name).read_bytes() == file.read_bytes()


def test_what_cannot_be_written_is_said(
    evaluation: Evaluation, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "file").write_text("")
    with pytest.raises(OutputError, match="file"):
        write_report(evaluation, tmp_path / "file" / "x")
    monkeypatch.setattr(provenance, "find_spec", lambda name: None)
    with pytest.raises(ExtraError, match="evaluate"):
        write_report(evaluation, tmp_path)
