"""Fill entries by an imputer of scikit-learn, for which every frame is a sample by itself."""

import os
import sys
from pathlib import Path

import numpy as np
from sklearn.experimental import enable_iterative_imputer  # noqa: F401
from sklearn.impute import IterativeImputer, KNNImputer


def _fill(name: str, folder: Path) -> None:
    seed = int(os.environ["MOCAPBENCH_SEED"])
    imputer = {
        "iterative": IterativeImputer(
            n_nearest_features=20, keep_empty_features=True, random_state=seed
        ),
        "knn": KNNImputer(n_neighbors=15, weights="distance", keep_empty_features=True),
    }[name]
    train = [np.load(path)["values"] for path in sorted((folder / "train").iterdir())]
    for path in sorted((folder / "given").iterdir()):
        values = np.load(path)["values"]
        frames = np.concatenate([*train, values])
        np.savez(folder / "filled" / path.name, mean=imputer.fit_transform(frames)[-len(values) :])


if __name__ == "__main__":
    _fill(sys.argv[1], Path(sys.argv[3]))  # after the step, which is always "fill"
