"""What the page says of models, metrics and tasks, once each."""

import pytest

from mocapbench.baselines import Imputer
from mocapbench.benchmark.docstrings import source, summary
from mocapbench.benchmark.registry import METRICS, MODELS, TASKS
from mocapbench.metrics import Direction
from mocapbench.reports.bundle.metric_info import MetricInfo
from mocapbench.reports.bundle.model_info import FAMILIES
from mocapbench.reports.bundle.task_page import QUESTIONS

MOST_WORDS = 30
MOST_WORDS_OF_A_DESCRIPTION = 60
MOST_WORDS_OF_A_REMARK = 40
UNITS = {"", "cm", "mm", "cm/s", "degrees", "nats", "that of the data", "that of the data, squared"}
UNITS |= {"steps of frequency", "skeleton units (5.64 cm in the CMU database)"}


def _is_short_sentence(text):
    return text.endswith(".") and len(text.split()) <= MOST_WORDS


@pytest.mark.parametrize("name", MODELS.names())
def test_every_model_has_a_sentence_a_source_and_one_of_the_families(name):
    model = MODELS.get(name)
    assert _is_short_sentence(summary(model))
    assert source(model)
    assert model.family in FAMILIES


def test_no_two_models_or_metrics_are_told_by_the_same_sentence():
    metrics = [METRICS.get(name).sentence for name in METRICS.names()]
    models = [summary(MODELS.get(name)) for name in MODELS.names()]
    assert len({*metrics, *models}) == len(metrics) + len(models)


@pytest.mark.parametrize("name", METRICS.names())
def test_every_metric_has_a_sentence_a_unit_a_range_and_a_source(name):
    metric = METRICS.get(name)
    assert _is_short_sentence(metric.sentence)
    assert metric.unit in UNITS
    assert " to " in metric.range
    assert metric.source


@pytest.mark.parametrize("name", TASKS.names())
def test_every_task_asks_a_known_question(name):
    assert TASKS.get(name).page.question in QUESTIONS


def _described(references):
    class Mine(Imputer):
        def fit(self, recordings):
            return self

        def impute(self, recordings):
            return []

    Mine.__doc__ = f"""Do it.

    References
    ----------
    {references}

    Examples
    --------
    >>> "A. Nobody (1999)"
    """
    return Mine


@pytest.mark.parametrize(
    ("references", "short"),
    [
        ("A. B. de Boor (2001), Splines.", "de Boor 2001"),
        ("A. Ax and B. Bo (1999), One.\n\n    Chi (2000), Two.", "Ax and Bo 1999; Chi 2000"),
        ("A. Ax, B. Bo and C. Chi (1999), a\n    title (2000).", "Ax et al. 1999"),
        ("D. Doe et al. (1999), Much.", "Doe et al. 1999"),
        ("Not from a publication. The task is that of A. Ax (1999).", "this project"),
    ],
)
def test_a_source_is_authors_and_year_of_each_reference(references, short):
    assert source(_described(references)) == short


def test_a_class_without_references_or_docstring_has_no_source():
    model = _described("")
    model.__doc__ = "Do it."
    assert source(model) == ""
    model.__doc__ = None
    assert source(model) == summary(model) == ""


@pytest.mark.parametrize("name", TASKS.names())
def test_the_texts_of_a_task_are_short(name):
    page = TASKS.get(name).page
    assert len(page.description.split()) <= MOST_WORDS_OF_A_DESCRIPTION
    assert all(len(remark.split()) <= MOST_WORDS_OF_A_REMARK for remark in page.remarks)


@pytest.mark.parametrize(
    ("name", "short"),
    [
        ("mpjpe", "MPJPE"),
        ("mpjpe_global", "global MPJPE"),
        ("smse_pooled", "pooled SMSE"),
        ("rms_per_frame", "Mean error norm per frame"),
        ("foot_skate", "Foot skate, cm/s"),
        ("purity", "Purity"),
    ],
)
def test_a_title_has_a_short_form(name, short):
    metric = METRICS.get(name)
    assert MetricInfo(name, metric.title, Direction.LOWER).short == short


@pytest.mark.parametrize("name", TASKS.names())
def test_the_short_forms_of_a_task_are_distinct(name):
    metrics = [METRICS.get(metric) for metric in TASKS.get(name).page.metrics]
    short = {MetricInfo(m.name, m.title, Direction.LOWER).short for m in metrics}
    assert len(short) == len(metrics)
