"""The assessment of the authored data: what follows what, and how various lives are, theme against theme.

    python -m reproduction.01_data_assessment.run

The paper sets a language model's train station against annotated video. No such annotations can be shipped, so the
figures on record compare the two authored themes; `genc assess` takes annotations of your own as a CSV file.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

from genc.evaluate.assessment import Assessment, assess
from genc.evaluate.assessment_report import deviations_table
from genc.evaluate.lives import of_samples
from genc.evaluate.tables import markdown_table
from genc.evaluate.transition_maps import transition_maps
from genc.learn.dataset import SPLITS
from reproduction.study import THEMES, Result, Study, door, number

N_SHOWN = 8


def run(study: Study, paper: Any) -> Result:
    """Entropies with intervals, the greatest differences between the themes, and the matrices as pictures."""
    dataset = study.dataset()
    lives = (of_samples(t, [s for part in SPLITS for s in dataset.split(part, t)]) for t in THEMES)
    found = assess(*lives, seed=study.seed)
    text = _entropies(found, paper)
    text += "\n\nA: {}, B: {}; in per cent of what follows the first action:\n\n".format(*THEMES)
    text += deviations_table(found, N_SHOWN)
    figures = {name: value for name, value in found.as_json().items() if name != "deviations"}
    return Result(figures, text, {"transitions.png": transition_maps(found)})


def _entropies(found: Assessment, paper: Any) -> str:
    ours = {f"{s.lives.name}, {found.size} agents": (s.entropy, s.low, s.high) for s in found.sides.values()}
    rows = [[name, *(number(value, 3) for value in interval)] for name, interval in (paper | ours).items()]
    return markdown_table(["normalised entropy of action sequences", "", "95 % from", "to"], rows)


if __name__ == "__main__":
    door([Path(__file__).parent.name], __doc__)
