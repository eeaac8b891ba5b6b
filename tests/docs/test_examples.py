"""What the documentation shows, runs."""

from __future__ import annotations

import re
import runpy
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]


@pytest.mark.parametrize("path", sorted((ROOT / "examples").glob("*.py")), ids=lambda path: path.stem)
def test_every_example_runs_and_says_something(path, capsys):
    runpy.run_path(str(path), run_name="__main__")
    assert "Group 0" in capsys.readouterr().out


def test_the_snippet_of_the_readme_runs(capsys):
    (snippet,) = re.findall(r"```python\n(.*?)```", (ROOT / "README.md").read_text(), re.S)
    exec(compile(snippet, "README.md", "exec"), {})
    assert "Group 0" in capsys.readouterr().out


def test_the_readme_names_only_what_exists():
    readme = (ROOT / "README.md").read_text()
    for link in re.findall(r"\]\(([^)#]+)\)", readme):
        assert (ROOT / link).exists(), link
    commands = (ROOT / "docs/cli.md").read_text()
    for command in re.findall(
        r"genc ((?:populate|stage|story|render|export|train|dataset build|corpus stats))\b", readme
    ):
        assert f"genc {command}" in commands, command
    for option in set(re.findall(r"(--[a-z]+)", readme)):
        assert option in commands or option in ("--repeats", "--no-deps"), option
