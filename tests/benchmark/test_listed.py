"""What tables say of models and tasks is what these say themselves."""

from mocapbench.baselines import LinearImputer
from mocapbench.benchmark.catalogue import listed
from mocapbench.benchmark.registry import MODELS


def test_the_file_says_what_models_and_tasks_do():
    advice = "run `python -m mocapbench.benchmark.catalogue.listed` in the clone"
    assert listed.TABLE.read_bytes() == listed.compose_table(), advice


def test_a_model_in_place_of_one_of_ours_speaks_for_itself():
    class Mine(LinearImputer):
        """Fill as nobody does."""

    with MODELS.lend("makima", Mine):
        assert listed.list_model("makima")["summary"] == "Fill as nobody does."


def test_a_model_of_others_speaks_for_itself():
    class Mine(LinearImputer):
        """Fill as others do."""

    with MODELS.lend("mine", Mine):
        assert listed.list_model("mine")["summary"] == "Fill as others do."
