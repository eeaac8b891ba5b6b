"""CSV files that people fill in, read with every fault at once: `file:line: what is wrong; what to do`.

UTF-8, commas, one header, one row a line. Lines that begin with `#` and empty lines are skipped, and spaces around a
cell do not count.
"""

from __future__ import annotations

import csv
from collections.abc import Sequence
from pathlib import Path

from genc.errors import StudyError
from genc.scenario.draft import clean

Row = tuple[str, list[str]]
"""Where it stands, and its cells."""


def read_rows(path: Path | str, columns: Sequence[str]) -> tuple[list[Row], list[str]]:
    """The rows below the header that have a cell for each column, and the problems of the others.

    Raises:
        StudyError: if the file cannot be read, or has another header.
    """
    rows: list[Row] = []
    problems: list[str] = []
    header: list[str] | None = None
    for number, line in enumerate(_text(path).split("\n"), start=1):
        if not line.strip() or line.startswith("#"):
            continue
        where = f"{path}:{number}"
        try:
            cells = [clean(cell) for cell in next(csv.reader([line], strict=True))]
        except csv.Error as error:
            problems.append(f"{where}: no CSV ({error}); a row is one line, and a quote closes in it")
            continue
        if header is None:
            header = cells
            if cells != list(columns):
                raise StudyError([f"{where}: the header is {clean(line)[:60]!r}; write '{','.join(columns)}'"])
        elif len(cells) != len(columns):
            problems.append(f"{where}: {len(cells)} cells; write {len(columns)}: {','.join(columns)}")
        else:
            rows.append((where, cells))
    return rows, problems


def settle(path: Path | str, rows: Sequence[Row], problems: Sequence[str], page: str) -> None:
    """Lets a file pass that has rows and no problems; `page` of the documentation describes its format.

    Raises:
        StudyError: with every problem, if there is any or no row.
    """
    if problems:
        raise StudyError(problems)
    if not rows:
        raise StudyError([f"{path}: no rows; write a header and one row each, as {page} says"])


def _text(path: Path | str) -> str:
    try:
        return Path(path).read_text(encoding="utf-8-sig")
    except UnicodeDecodeError as error:
        raise StudyError([f"{path}: not UTF-8 text (byte {error.start}); save it as UTF-8"]) from None
    except (OSError, ValueError) as error:
        reason = getattr(error, "strerror", None) or error
        raise StudyError([f"{path}: cannot be read ({reason}); check the name and the rights"]) from None
