from __future__ import annotations

import genc

NAMES = """
Brief CrowdGraph GencError GraphSource World build_dataset load_corpus load_dataset load_generator load_scripts
plan_crowd populate read_environment read_world rehearse stage tell_agent tell_group train unfold weave write_script
write_world
""".split()


def test_the_public_names_are_these_and_all_exist():
    assert genc.__all__ == sorted(NAMES)
    for name in NAMES:
        assert getattr(genc, name).__doc__, name
