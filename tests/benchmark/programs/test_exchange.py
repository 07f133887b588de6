"""What a program is told is what the recording says, and comes back to the last digit."""

import pickle

import numpy as np
import pytest
import scipy.io

from mocapbench.benchmark.programs.exchange import EXCHANGES

NUMBERS = {
    "values": np.array([[1.0 / 3.0, np.nan], [-2e-300, 5e20], [0.0, 7.0]]),
    "times": np.array([0.0, 0.1, 0.2]),
}
TEXTS = {"channels": np.array(['Knie, "links"', "ヒップ"]), "units": np.array(["deg", ""])}


@pytest.mark.parametrize("exchange", EXCHANGES.values(), ids=EXCHANGES)
def test_numbers_come_back_to_the_last_digit(exchange, tmp_path):
    path = tmp_path / f"one{exchange.suffix}"
    exchange.write(path, NUMBERS)
    read = exchange.read(path)
    for name, array in NUMBERS.items():
        np.testing.assert_array_equal(np.ravel(read[name]), np.ravel(array), strict=True)
    assert read["values"].shape == NUMBERS["values"].shape


def test_texts_are_readable_in_each_way(tmp_path):
    for name, exchange in EXCHANGES.items():
        exchange.write(tmp_path / f"{name}{exchange.suffix}", TEXTS)
    with np.load(tmp_path / "npz.npz") as held:
        assert held["channels"].tolist() == TEXTS["channels"].tolist()
    cells = scipy.io.loadmat(tmp_path / "mat.mat", simplify_cells=True)["channels"]
    assert list(cells) == TEXTS["channels"].tolist()
    lines = (tmp_path / "csv" / "channels.csv").read_text(encoding="utf-8").splitlines()
    assert lines == ['"Knie, ""links"""', "ヒップ"]


def test_what_r_and_julia_write_for_a_missing_number_is_nan(tmp_path):
    (tmp_path / "mean.csv").write_text("NA,1\nNaN,2\n")
    read = EXCHANGES["csv"].read(tmp_path)["mean"]
    np.testing.assert_array_equal(read, [[np.nan, 1.0], [np.nan, 2.0]])


@pytest.mark.parametrize("content", [b"mean 1 2", pickle.dumps({"mean": 1.0}), b""])
def test_what_is_no_archive_is_refused_without_advice_to_load_it_unsafely(content, tmp_path):
    path = tmp_path / "0001.npz"
    path.write_bytes(content)
    with pytest.raises(ValueError, match="no archive of arrays"):
        EXCHANGES["npz"].read(path)
