"""The house rules that a linter does not know."""

from __future__ import annotations

import ast
import re
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

import genc
from genc import errors
from genc.scenario.corpus import themes

PACKAGE = Path(genc.__file__).parent
MODULES = sorted(PACKAGE.rglob("*.py"))
ROOMS = sorted(path.parent for path in PACKAGE.glob("*/__init__.py"))


def _names(path: Path) -> str:
    return str(path.relative_to(PACKAGE))


def _imports(path: Path) -> Iterator[str]:
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            yield node.module or ""


def test_no_file_is_too_long():
    assert {_names(p): n for p in MODULES if (n := len(p.read_text().splitlines())) > 400} == {}


def test_no_file_is_a_drawer_for_everything():
    assert not {p.stem for p in MODULES} & {"utils", "util", "helpers", "common", "misc", "manager", "base"}


@pytest.mark.parametrize("room", ROOMS, ids=lambda room: room.name)
def test_each_room_says_what_it_is_for(room):
    said = ast.get_docstring(ast.parse((room / "__init__.py").read_text(encoding="utf-8"))) or ""
    for word in ("In:", "Out:", "May import:"):
        assert word in said


def test_only_the_command_line_prints_or_exits():
    for path in MODULES:
        tree = ast.parse(path.read_text(encoding="utf-8"))
        called = {ast.unparse(node.func) for node in ast.walk(tree) if isinstance(node, ast.Call)}
        assert "cli" in path.parts or not called & {"print", "exit", "sys.exit", "SystemExit", "os._exit"}, path


def test_nothing_is_pickled_and_nobody_imports_the_root_from_inside():
    for path in MODULES:
        assert not {"pickle", "dill", "joblib", "genc"} & set(_imports(path)), path
        assert "torch.load" not in path.read_text(encoding="utf-8"), path


def test_no_theme_stands_in_code():
    known = set(themes())
    for path in MODULES:
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if isinstance(node, ast.Constant) and isinstance(node.value, str):
                assert node.value.replace("_", " ") not in known, path


def test_the_tree_of_errors_is_drawn_as_it_is():
    drawn = set(re.findall(r"^    (?:\+-- )?(\w+Error) ", errors.__doc__ or "", re.M))
    kinds = {name for name, kind in vars(errors).items() if isinstance(kind, type) and kind.__module__ == "genc.errors"}
    assert drawn == kinds
    assert all(issubclass(getattr(errors, name), errors.GencError) for name in kinds)


@pytest.mark.parametrize(
    ("modules", "heavy"),
    [
        ("genc", "numpy scipy torch transformers click"),
        ("genc.cli", "numpy scipy torch transformers"),
        ("genc.plan.crowd genc.motion.executor genc.world.story genc.world.world_file", "torch transformers"),
    ],
)
def test_nothing_heavy_is_loaded_before_it_is_needed(modules, heavy):
    program = f"import sys, {', '.join(modules.split())}; print(*sorted(sys.modules))"
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True)
    assert not set(heavy.split()) & set(done.stdout.split())
