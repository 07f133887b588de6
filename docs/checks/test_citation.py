"""The page on citing says what CITATION.cff says."""

from pathlib import Path

import yaml
from citation import as_bibtex, as_text

CITED = yaml.safe_load((Path(__file__).parents[2] / "CITATION.cff").read_text(encoding="utf-8"))


def test_the_text_names_who_what_when_and_where():
    for work in [CITED, *CITED["references"]]:
        text = as_text(work)
        assert f"*{work['title']}*" in text
        assert all(name in text for author in work["authors"] for name in author.values())
        assert str(work.get("year", work.get("version"))) in text


def test_the_entry_has_balanced_braces_and_the_version():
    entry = as_bibtex(CITED)
    assert entry.count("{") == entry.count("}")
    assert f"{{{CITED['version']}}}" in entry
    assert f"{{{{{CITED['authors'][0]['name']}}}}}" in entry
