from mocapbench.reports.paper.citations import CITATIONS, citations_of


def test_papers_are_cited_once_in_order_of_appearance():
    references = ("HLM §4.1, Figures 1 and 2", "thesis §5.1.1", "thesis §5.1.2", "HLM §4.3")
    assert list(citations_of(references)) == ["HLM", "thesis"]


def test_what_names_no_paper_is_cited_nowhere():
    assert citations_of(["Small", "synthesis"]) == {}


def test_the_thesis_is_named_in_full():
    assert CITATIONS["thesis"] == (
        "J. D. Gil López, Hierarchical Multiple Output Gaussian Processes for Human Motion Data, "
        "MSc thesis, Universidad Tecnológica de Pereira, 2017"
    )


def test_the_page_names_every_paper_that_it_cites_in_full_once(page):
    body = page[page.index("<body>") :]
    for name, citation in citations_of(["thesis", "GPDM"]).items():
        assert f"{name} §" in body
        assert body.count(citation) == 1
