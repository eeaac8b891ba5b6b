"""`genc populate`, `genc stage`, `genc story` as a user meets them: by exit code and lines."""

from __future__ import annotations

import base64
import json
import subprocess
import sys
from pathlib import Path

import pytest

from genc.cli import cli
from genc.cli.worlds import PAGE, WORLD_FILE

TEXT = "Visitors wait for the tour and look at the bones"
SCRIPT = Path(__file__).parents[2] / "src/genc/corpora/museum/01.txt"


@pytest.fixture(scope="module")
def world(model, tmp_path_factory):
    from click.testing import CliRunner

    out = tmp_path_factory.mktemp("world")
    args = ["populate", TEXT, "--agents", "17", "--theme", "museum", "--minutes", "3", "--model", str(model)]
    result = CliRunner().invoke(cli, [*args, "--out", str(out)], catch_exceptions=False)
    assert result.exit_code == 0
    return out


def test_help_loads_neither_torch_nor_a_language_encoder():
    program = "import sys; from genc.cli import cli; cli(['--help'], standalone_mode=False); print(*sys.modules)"
    loaded = subprocess.run([sys.executable, "-c", program], check=True, capture_output=True, text=True).stdout.split()
    assert not {"torch", "transformers", "numpy", "scipy"} & set(loaded)


def test_the_same_command_gives_the_same_bytes_and_another_seed_another_crowd(genc, model, tmp_path, world):
    args = ["populate", TEXT, "--agents", 17, "--theme", "museum", "--minutes", 3, "--model", model]
    assert genc(*args, "--out", tmp_path / "a")[0] == 0
    assert genc(*args, "--out", tmp_path / "b", "--seed", 1)[0] == 0
    first, again, other = (folder / WORLD_FILE for folder in (world, tmp_path / "a", tmp_path / "b"))
    assert first.read_bytes() == again.read_bytes()
    assert first.read_bytes() != other.read_bytes()


def test_the_summary_as_json_says_what_was_made(genc, model, tmp_path):
    code, out, _ = genc("populate", TEXT, "--agents", 5, "--minutes", 1, "--model", model, "--out", tmp_path, "--json")
    said = json.loads(out)
    assert (code, said["agents"], said["seed"], said["minutes"], said["text"]) == (0, 5, 0, 1.0, TEXT)


def test_a_page_comes_with_the_world_unless_it_is_not_wanted(genc, model, tmp_path, world):
    assert base64.b64encode((world / WORLD_FILE).read_bytes()) in (world / PAGE).read_bytes()
    args = ["populate", TEXT, "--agents", 3, "--minutes", 1, "--model", model, "--out", tmp_path]
    code, out, _ = genc(*args, "--no-page")
    assert (code, PAGE in out, (tmp_path / PAGE).exists()) == (0, False, False)
    code, out, _ = genc(*args)
    assert f"{tmp_path / PAGE}: open it in a browser" in out
    assert genc(*args, "--json")[1].count(str(tmp_path / PAGE)) == 1


def test_a_story_can_be_told_of_all_of_a_group_and_of_a_person(genc, world):
    for args in ([], ["--group", 0], ["--agent", 3]):
        code, out, _ = genc("story", world, *args)
        assert code == 0
        assert len(out.splitlines()) > 1
    assert genc("story", world / WORLD_FILE)[0] == 0


def test_a_script_is_staged_with_all_its_people(genc, tmp_path):
    code, out, _ = genc("stage", SCRIPT, "--minutes", 2, "--out", tmp_path, "--json")
    assert code == 0
    assert json.loads(out)["agents"] > 30
    code, _, err = genc("stage", SCRIPT, "--scenario", "nowhere", "--out", tmp_path)
    assert (code, len(err)) == (2, 1)


def test_an_environment_that_lacks_what_the_crowd_needs_is_noted(genc, model, tmp_path):
    layout = tmp_path / "hall.txt"
    layout.write_text("L: hall | room | 0,0 | 20x10\nL: kiosk | service area | 5,2 | 3x2\n")
    code, _, err = genc("populate", TEXT, "--agents", 12, "--environment", layout, "--model", model, "--out", tmp_path)
    assert code == 0
    assert err[0].startswith("note: this environment has no entrance")
    code, out, _ = genc("story", tmp_path)
    assert "hall" in out


def _bad_inputs(tmp_path: Path, model: Path) -> dict[str, tuple[list[object], str]]:
    one = tmp_path / "one.json"
    one.write_text('{"locations": [{"name": "gate", "category": "entrance", "position": [0, 0], "scale": [2, 2]}]}')
    cut = tmp_path / "cut"
    cut.mkdir()
    for name in ("config.json", "model.safetensors"):
        content = (model / name).read_bytes()
        (cut / name).write_bytes(content[: len(content) // (1 if name == "config.json" else 2)])
    file = tmp_path / "file"
    file.write_text("")
    populate = ["populate", TEXT, "--model", model, "--agents", 3]
    return {
        "empty sentence": (["populate", "  "], "sentence is empty"),
        "no agents": (["populate", TEXT, "--agents", 0], "crowd of 0"),
        "a million agents": (["populate", TEXT, "--agents", 1_000_000], "crowd of 1000000"),
        "negative minutes": (["populate", TEXT, "--minutes", -1], "-1.0 minutes"),
        "nan minutes": (["populate", TEXT, "--minutes", "nan"], "nan minutes"),
        "unknown theme": (["populate", TEXT, "--theme", "train staton"], "did you mean"),
        "guidance": ([*populate, "--guidance", -3], "guidance of -3"),
        "one location": ([*populate, "--environment", one], "one"),
        "no such layout": ([*populate, "--environment", tmp_path / "none.txt"], "none.txt"),
        "cut weights": (["populate", TEXT, "--model", cut], "cut short"),
        "no model": (["populate", TEXT, "--model", tmp_path], "no model here"),
        "unwritable": ([*populate, "--out", file / "world"], "cannot be written"),
        "no such script": (["stage", tmp_path / "none.txt"], "none.txt"),
        "both": (["story", tmp_path, "--agent", 1, "--group", 1], "one or the other"),
        "no world": (["story", tmp_path], "world.genc"),
        "foreign world": (["story", one], "one.json"),
    }


def test_bad_input_gets_one_clear_line_and_exit_code_2(genc, model, tmp_path):
    for name, (args, said) in _bad_inputs(tmp_path, model).items():
        before = sorted(tmp_path.rglob("*"))
        where = ["--out", tmp_path / "w"] if args[0] == "populate" and "--out" not in args else []
        code, out, err = genc(*args, *where)
        assert (code, out, len(err)) == (2, "", 1), (name, code, out, err)
        assert err[0].startswith("error: "), name
        assert said in err[0], (name, err[0])
        made = [p for p in sorted(tmp_path.rglob("*")) if p not in before and p != tmp_path / "w"]
        assert not made, (name, made)


def test_a_script_with_ten_faults_gets_ten_lines(genc, tmp_path):
    script = tmp_path / "faulty.txt"
    script.write_text(
        "\n".join(
            [
                "=== a scene",
                "S: people meet",
                "L: gate | entrance | 0,0 | 2x2",
                "L: gate | entrance | 9,0 | 2x2",
                "L: hut | shed | 3,3 | 1x1",
                "L: pit | room | 3 | 1x1",
                "L: line | room | 5,5 | 0x1",
                "G: a pair",
                "1 - ab: dance@gate",
                "2 - a: wait@nowhere",
                "3 >9 ab: wait@gate",
                "3 - ab: wait@gate",
                "4 - aa: wait@gate",
                "gibberish",
            ]
        )
    )
    code, _, err = genc("stage", script, "--out", tmp_path / "w")
    assert code == 2
    assert len(err) == 10
    assert all(line.startswith(f"error: {script}:") for line in err)


@pytest.mark.parametrize("share", [0.0, 0.1, 0.5, 0.999])
def test_a_world_file_cut_in_the_middle_is_refused(genc, world, tmp_path, share):
    content = (world / WORLD_FILE).read_bytes()
    (tmp_path / WORLD_FILE).write_bytes(content[: int(share * len(content))])
    code, _, err = genc("story", tmp_path)
    assert (code, len(err)) == (2, 1)
    assert WORLD_FILE in err[0]
