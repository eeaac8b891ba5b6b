from __future__ import annotations

import genc

NAMES = [
    *("Brief", "CrowdGraph", "GencError", "GraphSource", "World"),
    *("load_corpus", "load_scripts", "read_environment", "rehearse", "write_script"),
    *("unfold", "weave", "build_dataset", "load_dataset", "train", "load_generator"),
    *("plan_crowd", "populate", "stage", "read_world", "write_world", "export_world", "tell_agent", "tell_group"),
    *("Trial", "examine", "load_source", "read_material", "write_report"),
    *("assess", "read_lives", "write_assessment"),
]


def test_the_public_names_are_these_and_all_exist():
    assert genc.__all__ == sorted(NAMES)
    for name in NAMES:
        assert getattr(genc, name).__doc__, name
