"""A table is read alike, and written as it was, whatever spreadsheets and hands do to its text."""

import csv

import numpy as np
import pytest
from vendor_tables import RATE, TABLES, TIMES, N

from mocapbench.datasets import CSVFormat

CSV = CSVFormat()
NEW = 123456.5


def separator_of(table):
    if table.name.endswith((".tsv", ".mot", ".sto")):
        return "," if ",pelvis_tx" in table.text else "\t"
    return ","


def change_lines(change):
    """Return a habit that changes each line, given without its end, the separator and its place."""

    def habit(table):
        lines = table.text.splitlines()
        separator, end = separator_of(table), "\r\n" if "\r\n" in table.text else "\n"
        width = max(line.count(separator) for line in lines[-N:])
        return "".join(change(line, separator, width) + end for line in lines)

    return habit


def quote_cells(line, separator, _):
    cells = next(csv.reader([line], delimiter=separator)) if line else []
    return separator.join(f'"{cell}"' for cell in cells)


def pad_line(line, separator, width):
    return line + separator * max(width - line.count(separator), 0)


def add_blank_rows(table):
    separator = separator_of(table)
    return table.text + (separator * table.text.splitlines()[-1].count(separator) + "\r\n") * 2


HABITS = {
    "cells in quotes": change_lines(quote_cells),
    "blanks beside cells": change_lines(
        lambda line, separator, _: line.replace(separator, f"{separator} ")
    ),
    "lines padded to one length": change_lines(pad_line),
    "a separator after each line": change_lines(lambda line, separator, _: line + separator),
    "blank lines above": lambda table: f"\r\n{separator_of(table)}\r\n{table.text}",
    "what Excel is told": lambda table: f"sep={separator_of(table)}\r\n{table.text}",
    "rows of separators below": add_blank_rows,
    "no end of the last line": lambda table: table.text.rstrip("\r\n"),
}
DIFFERENT = {
    ("opensim quaternions", "cells in quotes"),  # four numbers in a cell
    ("opensim, blanks", "cells in quotes"),
    ("freemocap", "rows of separators below"),  # these are frames without anybody
}


@pytest.mark.parametrize("habit", HABITS)
@pytest.mark.parametrize("name", TABLES)
def test_a_table_is_read_alike_and_written_as_it_was(name, habit, tmp_path):
    if (name, habit) in DIFFERENT:
        pytest.skip("another table")
    table = TABLES[name]
    path, out = tmp_path / table.name, tmp_path / f"out-{table.name}"
    path.write_text(HABITS[habit](table), encoding="utf-8", newline="")
    rate = None if table.rate else RATE
    recording = CSV.load(path, rate)
    assert (recording.channels, recording.units) == (table.channels, table.units)
    np.testing.assert_allclose(recording.values, table.values)
    np.testing.assert_allclose(recording.times, TIMES)
    new = ~recording.visible
    CSV.save(out, np.full(new.shape, NEW), np.zeros_like(new), path)
    assert out.read_bytes() == path.read_bytes()
    CSV.save(out, np.full(new.shape, NEW), new, path)
    again = CSV.load(out, rate)
    assert (again.values[new] == NEW).all()
    np.testing.assert_array_equal(again.values[~new], recording.values[~new])


def test_rows_of_separators_are_frames_where_nothing_counts_frames(tmp_path):
    table = TABLES["freemocap"]
    path = tmp_path / table.name
    path.write_text(add_blank_rows(table), newline="")
    assert len(CSV.load(path, RATE).times) == N + 2


@pytest.mark.parametrize(("rate", "stated"), [("119,88", 119.88), ("59,94", 59.94)])
def test_a_rate_may_have_a_decimal_comma(rate, stated, tmp_path):
    table, path = TABLES["nexus"], tmp_path / "trial.csv"
    text = table.text.replace(",", ";").replace(".", ",").replace("\r\n100\r\n", f"\r\n{rate}\r\n")
    path.write_text(text, newline="")
    assert CSV.load(path, None).times[1] == pytest.approx(1 / stated)


def test_names_that_numpy_writes_as_a_comment_are_names(tmp_path):
    path = tmp_path / "walk.csv"
    np.savetxt(path, [[0.0, 1.5], [0.01, 2.5]], delimiter=",", header="time,hip.x [mm]")
    walk = CSV.read(path)
    assert (walk.channels, walk.units, walk.times.tolist()) == (("hip.x",), ("mm",), [0.0, 0.01])
