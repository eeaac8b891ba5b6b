"""An assessment on paper: `assessment.md` with its picture, `assessment.json`, and the matrices as CSV."""

from __future__ import annotations

import csv
import io
import json
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from genc.evaluate.assessment import Assessment
from genc.evaluate.provenance import check_extra
from genc.evaluate.tables import markdown_table
from genc.evaluate.transition_maps import transition_maps
from genc.files import ensure_folder, write_text, written_beside
from genc.words.vocabulary import ACTIONS

PAGE, RESULT, PICTURE = "assessment.md", "assessment.json", "transitions.png"
MATRICES = ("transitions_a.csv", "transitions_b.csv", "transitions_difference.csv")
N_DEVIATIONS = 12
_DPI = 100


def write_assessment(assessment: Assessment, folder: Path | str) -> Path:
    """Writes the six files into a folder, which is made if need be, and gives back the path of the page.

    Equal assessments make equal bytes, where matplotlib and its fonts are the same.

    Raises:
        ExtraError: if the extra `evaluate` is not installed.
        OutputError: if nothing can be written there.
    """
    check_extra()
    place = ensure_folder(folder)
    matrices = (assessment.a.transitions, assessment.b.transitions, assessment.difference)
    for name, matrix in zip(MATRICES, matrices, strict=True):
        write_text(place / name, matrix_csv(matrix))
    with written_beside(place / PICTURE) as beside:
        transition_maps(assessment).savefig(beside, format="png", dpi=_DPI, metadata={"Software": None})
    write_text(place / RESULT, json.dumps(assessment.as_json(), ensure_ascii=False, indent=1, allow_nan=False) + "\n")
    write_text(place / PAGE, to_markdown(assessment))
    return place / PAGE


def matrix_csv(matrix: NDArray[np.float64]) -> str:
    """A row for each action left, a column for each that follows; empty cells where nothing is known."""
    text = io.StringIO()
    table = csv.writer(text, lineterminator="\n")
    table.writerow(["from/to", *ACTIONS])
    for action, row in zip(ACTIONS, matrix.tolist(), strict=True):
        table.writerow([action, *("" if np.isnan(share) else f"{share:.6f}" for share in row)])
    return text.getvalue()


def to_markdown(assessment: Assessment) -> str:
    """The page: both corpora in figures, the picture, and where they differ most."""
    said = [
        "# Assessment",
        "\n".join(f"- {letter}: {side.lives.name}" for letter, side in assessment.sides.items()),
        figures_table(assessment),
        *(f"**Note.** {note}" for note in assessment.notes),
        "## What follows what",
        f"![Transitions of A, of B, and A less B]({PICTURE})",
        "In per cent of what follows the action of the row; at the right of each row, of how many transitions. Grey "
        "rows are unknown. In A − B a number stands where the 95 % interval of the difference leaves out 0.",
        "## The greatest differences",
        _how_many_are_sure(assessment),
        deviations_table(assessment),
    ]
    return "\n\n".join(said) + "\n"


def figures_table(assessment: Assessment) -> str:
    """Numbers of agents and steps, and the entropies, as a Markdown table."""
    told = [side.as_json() for side in assessment.sides.values()]
    intervals = [side["entropy"] for side in told]
    counts = {
        "scenarios or clips": "n_clusters",
        "agents (of video: tracks)": "n_agents",
        "steps": "n_steps",
        "distinct action sequences": "n_distinct_sequences",
    }
    rows = [[name, *(f"{side[key]:,}" for side in told)] for name, key in counts.items()]
    at_size = f"normalised entropy of {assessment.size:,} sequences"
    rows.append([at_size, *(f"{interval['mean']:.4f}" for interval in intervals)])
    rows.append(["its 95 % interval", *(_ends(interval["low"], interval["high"]) for interval in intervals)])
    rows.append(["of all, which do not compare", *(f"{side['entropy_of_all']:.4f}" for side in told)])
    return markdown_table(["", *assessment.sides], rows)


def deviations_table(assessment: Assessment, n_shown: int = N_DEVIATIONS) -> str:
    """The transitions that differ surely by the most, as a Markdown table; in per cent of what follows."""
    rows = [
        [
            f"{found.before} → {found.after}",
            *(f"{100 * share:.1f}" for share in (found.a, found.b)),
            f"{100 * found.difference.mean:+.1f}",
            f"{100 * found.difference.low:+.1f} to {100 * found.difference.high:+.1f}",
        ]
        for found in assessment.deviations[:n_shown]
    ]
    return markdown_table(["%", *assessment.sides, "A − B", "95 %"], rows)


def _how_many_are_sure(assessment: Assessment) -> str:
    n_sure = sum(deviation.sure > 0 for deviation in assessment.deviations)
    n = len(assessment.deviations)
    return (
        f"Of {n} transitions, {n_sure} have an interval that leaves out 0; about {round(0.05 * n)} would by chance "
        "alone. First come those that differ surely by the most: by that end of the interval which is nearer to 0."
    )


def _ends(low: float | None, high: float | None) -> str:
    return "" if low is None or high is None else f"{low:.4f} to {high:.4f}"
