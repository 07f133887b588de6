import json

import pytest

WHOLE = {"reference": "values", "summary": "nothing is worse", "passed": True, "findings": []}


def test_what_a_check_found_is_kept_until_the_next_plan(store):
    assert store.load_check() is None
    store.save_check(WHOLE)
    assert store.load_check() == WHOLE
    store.save_plan({"keys": [], "provenance": {}})
    assert store.load_check() is None
    assert store.damaged == []


@pytest.mark.parametrize("text", ["", "{", "5", "[]", "[[1, 2]]", json.dumps({"passed": True})])
def test_a_damaged_check_is_reported_and_not_trusted(store, text):
    (store.path / "check.json").write_text(text)
    assert store.load_check() is None
    assert "check.json: not a whole check" in store.damaged[0]
