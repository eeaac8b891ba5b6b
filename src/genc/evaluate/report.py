"""An evaluation on paper: `report.md`, `report.html` (one file, pictures inside) and `result.json`."""

from __future__ import annotations

import html
import json
from collections.abc import Iterator, Sequence
from importlib.resources import files
from pathlib import Path
from string import Template

from genc.evaluate.evaluation import Evaluation
from genc.evaluate.pictures import pictures
from genc.evaluate.provenance import check_extra
from genc.evaluate.tables import READING, Cell, Table, facts, tables
from genc.files import ensure_folder, write_text

MARKDOWN, PAGE, RESULT = "report.md", "report.html", "result.json"


def write_report(evaluation: Evaluation, folder: Path | str) -> Path:
    """Writes the three files into a folder, which is made if need be, and gives back the path of the page.

    Raises:
        ExtraError: if the extra `evaluate` is not installed.
        OutputError: if nothing can be written there.
    """
    check_extra()
    place = ensure_folder(folder)
    page = to_html(evaluation)
    write_text(place / RESULT, json.dumps(evaluation.as_json(), ensure_ascii=False, indent=1, allow_nan=False) + "\n")
    write_text(place / MARKDOWN, to_markdown(evaluation))
    write_text(place / PAGE, page)
    return place / PAGE


def to_markdown(evaluation: Evaluation) -> str:
    """The report as Markdown, without pictures."""
    said = [f"# {title(evaluation)}", *READING, *(f"**Note.** {note}" for note in evaluation.notes)]
    for table in (*tables(evaluation), facts(evaluation)):
        said += [f"## {table.title}", "\n".join(_markdown(table))]
    return "\n\n".join(said) + "\n"


def to_html(evaluation: Evaluation) -> str:
    """The report as one page that needs no other file."""
    notes = [f'<p class="note">{html.escape(note)}</p>' for note in evaluation.notes]
    drawn = [
        f"<figure>{svg}<figcaption>{html.escape(caption)}</figcaption></figure>"
        for caption, svg in pictures(evaluation).items()
    ]
    template = Template(files("genc.evaluate").joinpath("report_page.html").read_text(encoding="utf-8"))
    return template.substitute(
        title=html.escape(title(evaluation)),
        reading="\n".join([*(f"<p>{html.escape(line)}</p>" for line in READING), *notes]),
        tables="\n".join(_html(table) for table in tables(evaluation)),
        pictures="\n".join(drawn),
        facts=_html(facts(evaluation)),
    )


def title(evaluation: Evaluation) -> str:
    """What was evaluated, on what."""
    told = evaluation.facts
    return f"Evaluation of {told['model']}: {told['n_repeats']} × {told['n_test']} groups"


def _markdown(table: Table) -> Iterator[str]:
    yield _line(table.heads)
    yield "|---|" + "---:|" * (len(table.heads) - 1)
    for row in table.rows:
        yield _line([f"{cell.text} ({cell.aside})" if cell.aside else cell.text for cell in row])


def _line(cells: Sequence[str]) -> str:
    return "| " + " | ".join(cell.replace("|", "\\|") for cell in cells) + " |"


def _html(table: Table) -> str:
    heads = "".join(f'<th scope="col">{html.escape(head)}</th>' for head in table.heads)
    rows = "\n".join(f"<tr>{''.join(map(_cell, table.heads, row))}</tr>" for row in table.rows)
    head = f"<thead><tr>{heads}</tr></thead>" if any(table.heads) else ""
    return f"<section><h2>{html.escape(table.title)}</h2><table>{head}<tbody>\n{rows}\n</tbody></table></section>"


def _cell(head: str, cell: Cell) -> str:
    aside = f" <small>{html.escape(cell.aside)}</small>" if cell.aside else ""
    kind = ' class="ratio"' if head.endswith("× floor") else ""
    return f"<td{kind}>{html.escape(cell.text)}{aside}</td>"
