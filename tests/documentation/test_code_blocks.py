"""What is wrong in a code block is found, whatever its language."""

import pytest
from code_blocks import code_blocks

pytestmark = pytest.mark.slow


@pytest.fixture
def tried(desk):
    """Return a function that tries a page of one block."""

    def tried(language, *lines):
        page = desk / "page.md"
        page.write_text("\n".join([f"```{language}", *lines, "```", ""]), encoding="utf-8")
        for example in code_blocks(page):
            example.evaluate()

    return tried


@pytest.mark.parametrize(
    "block",
    [
        ("sh", "mocapbench run --profile quick --dry-run  # a comment"),
        ("sh", "mocapbench run --tasks golf-swings \\", "    --models knn"),
        ("sh", "T=golf-swings", "mocapbench run --tasks $T"),
        ("sh", "mocapbench data fetch 35_02"),
        ("sh", "python3 -m venv .venv && .venv/bin/pip install 'mocapbench[cluster]'"),
        ("sh", ".venv/bin/pytest tests/metrics", 'pytest -m "not slow"'),
        ("console", "$ mocapbench list libraries", "...gait...", "$ echo $?", "0"),
        ("toml", "# tolerances.toml", "[same]", "k = 2"),
        ("text", "a tree"),
        ("{toctree}", "start"),
    ],
    ids=" ".join,
)
def test_what_is_right_passes(tried, block):
    tried(*block)


@pytest.mark.parametrize(
    "block",
    [
        ("", "a tree"),
        ("bash", "mocapbench info"),
        ("{code-block} python", "1 + 1"),
        ("python", "import mocapbench.nothing"),
        ("sh", "mocapbench run --no-such-option"),
        ("sh", "mocapbench run --tasks no-such-task"),
        ("sh", "mocapbench run --plugin no_such_file.py"),
        ("sh", "mocapbench status no-such-run"),
        ("sh", "mocapbench data fetch --no-such-option"),
        ("sh", "mocapbench --no-such-option"),
        ("sh", "mocapbench no-such-command"),
        ("sh", "pip install 'mocapbench[nothing]'"),
        ("sh", "tox run -e nothing"),
        ("sh", "tox run -e bench -- --no-such-option"),
        ("sh", "python no_such_file.py"),
        ("sh", "pytest tests/nothing"),
        ("sh", "pytest -m nothing"),
        ("sh", "dask worker --no-such-option"),
        ("sh", "git pusch"),
        ("sh", "curl https://example.org"),
        ("console", "mocapbench info"),
        ("console", "$ mocapbench list libraries", "something else"),
        ("console", "$ mocapbench status no-such-run", "...", "$ echo $?", "0"),
        ("console", "$ tox run -e tests"),
        ("toml", 'files = ["*.csv"]'),
        ("toml", "# tolerances.toml", "[same]", "nothing = 2"),
        ("toml", "# wrong.toml", 'files = ["*.csv"]', "[hide]", "fraction = 0.2"),
        ("toml", "# pyproject.toml", '[project.entry-points."mocapbench.nothing"]'),
        ("yaml", "jobs: {a: {steps: [{run: mocapbench run --no-such-option}]}}"),
    ],
    ids=" ".join,
)
def test_what_is_wrong_fails(tried, block):
    with pytest.raises((Exception, SystemExit)):
        tried(*block)
