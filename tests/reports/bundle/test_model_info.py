"""The families of models, as rows of the report."""

from hypothesis import given
from hypothesis import strategies as st

from mocapbench.reports.bundle.model_info import FAMILIES, ModelInfo, in_families

families = st.sampled_from([*FAMILIES, "Networks", "Fuzzy logic"])


@given(st.dictionaries(st.text(min_size=1), st.builds(ModelInfo, st.just("m"), family=families)))
def test_every_label_stands_once_under_its_family_in_a_fixed_order(models):
    grouped = in_families(models)
    assert {label: family for family, labels in grouped.items() for label in labels} == {
        label: model.family for label, model in models.items()
    }
    assert sum(map(len, grouped.values())) == len(models)
    ours = [family for family in grouped if family in FAMILIES]
    assert ours == sorted(ours, key=FAMILIES.index)


def test_families_of_plug_ins_come_before_models_that_declare_none_and_references():
    names = ["References", "Your models", "Networks", "Neighbours"]
    models = {name: ModelInfo(name, family=name) for name in names}
    assert list(in_families(models)) == ["Neighbours", "Networks", "Your models", "References"]
