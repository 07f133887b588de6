from mocapbench.benchmark import Address

ADDRESS = Address("missing-frames", 1, "07-01 three-walkers", 3, "knn")


def test_its_text_counts_folds_from_one():
    assert str(ADDRESS) == "missing-frames · 07-01 three-walkers · knn · fold 4"


def test_all_folds_of_an_entrant_share_an_address():
    assert ADDRESS.all_folds == ADDRESS._replace(fold=7).all_folds
    assert str(ADDRESS.all_folds) == "missing-frames · 07-01 three-walkers · knn"
