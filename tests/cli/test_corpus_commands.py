from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path

import pytest
from click.testing import CliRunner, Result

from genc.cli.corpus import corpus
from genc.errors import GencError, OutputError, ScriptError
from genc.scenario.corpus import load_scripts
from genc.scenario.script import write_script

SCRIPT = """\
T: train station

=== kiosk
S: At the kiosk a woman buys a paper.
L: hall | room | 10,5 | 20x10
L: kiosk | service area | 4,2.5 | 3x2
L: bin | item | 1,1 | 1x1
G: a woman buys a paper
1 - a: queue@kiosk, object interact@kiosk
2 >1 a: wait@hall
"""


@pytest.fixture
def script(tmp_path: Path) -> Path:
    path = tmp_path / "kiosk.txt"
    path.write_text(SCRIPT, encoding="utf-8")
    return path


def run(*arguments: object) -> Result:
    return CliRunner().invoke(corpus, [str(argument) for argument in arguments])


def error_of(*arguments: object) -> GencError:
    result = run(*arguments)
    assert isinstance(result.exception, GencError), result.output
    return result.exception


def test_check_warns_of_thin_scripts_and_passes(script: Path) -> None:
    result = run("check", script)
    assert result.exit_code == 0
    assert f"warning: {script}:7: nobody uses 'bin'; use it or leave it out" in result.output
    assert f"warning: {script}:3: no paraphrases (P:); with 5 a model" in result.output
    assert result.output.endswith("scenarios: 1, groups: 1, no errors\n")


def test_check_tells_everything_of_every_file(script: Path, tmp_path: Path) -> None:
    script.write_text(SCRIPT.replace("queue@", "quue@").replace(">1", ">5"), encoding="utf-8")
    error = error_of("check", script, tmp_path / "none.txt")
    assert isinstance(error, ScriptError)
    assert sorted(error.problems) == [
        f"{script}:10: event 2 waits for event 5, which does not exist; "
        "name an event of this scenario, or '-' for the start",
        f"{script}:9: unknown action 'quue'; did you mean 'queue'?",
        f"{tmp_path}/none.txt: no such file; check the name",
    ]


def test_errors_reach_the_user_as_lines_and_exit_code_two(script: Path) -> None:
    script.write_text(SCRIPT.replace("queue@", "quue@").replace(">1", ">5"), encoding="utf-8")
    program = "import sys; from genc.cli import main; sys.exit(main())"
    done = subprocess.run(
        [sys.executable, "-c", program, "corpus", "check", str(script)],
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 2
    assert done.stdout == ""
    assert len(done.stderr.splitlines()) == 2
    assert all(line.startswith(f"error: {script}:") for line in done.stderr.splitlines())


def test_stats_of_the_shipped_corpus() -> None:
    result = run("stats")
    assert result.exit_code == 0
    lines = {line[:18].strip(): line[18:].split() for line in result.output.splitlines()}
    assert lines["groups"][-1] == "5,306"
    assert lines["agents"][-1] == "10,954"
    assert lines["nodes"][-1] == "78,707"
    assert len(lines["queue"]) == 10


def test_stats_as_json_of_one_script(script: Path) -> None:
    figures = json.loads(run("stats", "--json", script).output)
    assert list(figures) == ["train station"]
    assert figures["train station"]["n_nodes"] == 3
    assert figures["train station"]["action_shares"]["queue"] == pytest.approx(1 / 3)


def test_convert_there_and_back(script: Path, tmp_path: Path) -> None:
    there, back = tmp_path / "kiosk.json", tmp_path / "back.txt"
    assert run("convert", script, "--to", "json", "--out", there).exit_code == 0
    assert run("convert", there, "--to", "script", "--out", back).exit_code == 0
    assert load_scripts(back) == load_scripts(script)
    assert sorted(path.name for path in tmp_path.iterdir()) == ["back.txt", "kiosk.json", "kiosk.txt"]


def test_convert_prints_without_out(script: Path) -> None:
    assert run("convert", script, "--to", "script").output == write_script(load_scripts(script))


def test_convert_overwrites_only_when_told(script: Path, tmp_path: Path) -> None:
    out = tmp_path / "there.json"
    out.write_text("mine", encoding="utf-8")
    error = error_of("convert", script, "--to", "json", "--out", out)
    assert isinstance(error, OutputError)
    assert "is there already" in str(error)
    assert out.read_text(encoding="utf-8") == "mine"
    assert run("convert", script, "--to", "json", "--out", out, "--force").exit_code == 0
    assert out.read_text(encoding="utf-8").startswith("{")


def test_convert_leaves_nothing_behind_when_it_cannot_write(script: Path, tmp_path: Path) -> None:
    error = error_of("convert", script, "--to", "json", "--out", tmp_path, "--force")
    assert isinstance(error, OutputError)
    assert "cannot be written" in str(error)
    assert list(tmp_path.iterdir()) == [script]
    assert "cannot be written" in str(error_of("convert", script, "--to", "json", "--out", tmp_path / "no" / "x"))


def test_a_faulty_script_is_not_converted(script: Path, tmp_path: Path) -> None:
    script.write_text("nonsense", encoding="utf-8")
    error_of("convert", script, "--to", "json", "--out", tmp_path / "out.json")
    assert not (tmp_path / "out.json").exists()


def test_the_commands_load_nothing_heavy() -> None:
    program = "import sys, genc.cli.corpus; print([m for m in ('torch', 'scipy', 'numpy') if m in sys.modules])"
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "[]"
