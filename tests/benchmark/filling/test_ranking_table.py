from mocapbench.benchmark.filling.ranking_table import ranked


def test_the_ranking_notes_the_choice_and_over_whom_its_lead_may_be_chance(filled, choice_of):
    rows = list(ranked(filled(choice_of({"one": [1, 2, 1, 2, 1], "two": [2, 1, 2, 1.5, 1]}))))
    assert [row.name for row in rows] == ["one", "two"]
    assert rows[0].note == "chosen, fitted to windows"
    assert rows[1].note.startswith("lead of one may be chance")
