"""Reference values are text that holds every bit, as a file and as a folder."""

import pytest
from hypothesis import given
from hypothesis import strategies as st
from left_behind import leave_lock

from mocapbench.basics.temporaries import PREFIX
from mocapbench.basics.whole_files import write_together
from mocapbench.benchmark.errors import UsageError
from mocapbench.benchmark.gate.reference import Reference, Series
from mocapbench.benchmark.gate.reference_files import read_reference, write_reference
from mocapbench.benchmark.tasks.address import Address

ABOUT = {"profile": "smoke", "seed": "0", "machine": "m", "libc": "l: 2", "BLAS": "b"} | {
    f"{name} version": "1" for name in ("numpy", "scipy", "scikit-learn")
}
characters = st.characters(codec="utf-8", exclude_characters="\r\n")
names = st.text("ab#\", '=+-@\t", min_size=1, max_size=5) | st.text(characters, max_size=5)
addresses = st.builds(
    Address, st.sampled_from(["t", "u", "=t", "# t"]), st.integers(1, 3), names, st.none(), names
)
series = st.builds(Series, addresses, names)
by_fold = st.dictionaries(
    st.integers(0, 4), st.floats(allow_nan=False, allow_infinity=False), min_size=1
)


def _series(task="t", label="l", metric="mse"):
    return Series(Address(task, 1, "c", label=label), metric)


@pytest.mark.parametrize("name", ["reference.csv", "folder"])
@given(values=st.dictionaries(series, by_fold, min_size=1))
def test_what_is_written_is_read(tmp_path_factory, name, values):
    path = tmp_path_factory.mktemp("reference") / name
    write_reference(path, Reference(values, ABOUT))
    assert read_reference(path) == Reference(values, ABOUT)


@pytest.mark.parametrize("name", ["=1+1", "-1", "@a", "\ta"])
def test_no_name_begins_a_formula(tmp_path, name):
    write_reference(tmp_path / "b.csv", Reference({_series(label=name): {0: -1.0}}, ABOUT))
    assert f"t,1,c,'{name},mse,-1.0\n" in (tmp_path / "b.csv").read_text()


@pytest.mark.parametrize("name", ["=1+1", "'a", "''", "-1"])
def test_a_file_from_before_names_were_guarded_is_read(tmp_path, name):
    head = "# mocapbench baseline\ntask,version,case,label,metric,fold 0\n"
    (tmp_path / "b.csv").write_text(f"{head}t,1,c,{name},mse,1.0\n")
    assert read_reference(tmp_path / "b.csv").values == {_series(label=name): {0: 1.0}}


@pytest.mark.parametrize("name", ["a\nb", "a\rb"])
def test_a_name_that_breaks_a_line_is_refused(tmp_path, name):
    with pytest.raises(UsageError, match="expected names of one line"):
        write_reference(tmp_path / "b.csv", Reference({_series(label=name): {0: 1.0}}, ABOUT))
    assert [*tmp_path.iterdir()] == []


@pytest.mark.parametrize("task", ["../t", "/t", "a/b", "t\x1b[2J", "t\0", r"a\b", "t:", "CON"])
def test_a_task_that_names_no_file_of_the_folder_is_refused(tmp_path, task):
    reference = Reference({_series(task=task): {0: 1.0}}, ABOUT)
    with pytest.raises(UsageError, match="expected a task whose name can be that of a file"):
        write_reference(tmp_path / "folder", reference)
    assert [*tmp_path.iterdir()] == []
    write_reference(tmp_path / "b.csv", reference)
    assert read_reference(tmp_path / "b.csv") == reference


def test_a_task_that_is_gone_takes_its_file_along(tmp_path):
    one, two = (_series(task=task) for task in "tu")
    write_reference(tmp_path, Reference({one: {0: 1.0}, two: {0: 2.0}}, ABOUT))
    write_reference(tmp_path, Reference({two: {0: 2.0}}, ABOUT))
    assert [path.name for path in tmp_path.iterdir()] == ["u.csv"]


def test_a_value_takes_one_line_and_lines_are_sorted(tmp_path):
    values = {_series(label=label): {0: 0.1, 2: 1 / 3} for label in "ba"}
    write_reference(tmp_path / "b.csv", Reference(values, ABOUT))
    lines = (tmp_path / "b.csv").read_text().splitlines()
    assert lines[-3:] == [
        "task,version,case,label,metric,fold 0,fold 1,fold 2",
        "t,1,c,a,mse,0.1,,0.3333333333333333",
        "t,1,c,b,mse,0.1,,0.3333333333333333",
    ]


def test_nothing_there_holds_no_values(tmp_path):
    assert read_reference(tmp_path) is None
    assert read_reference(tmp_path / "absent.csv") is None


@pytest.mark.parametrize(
    "text",
    [
        "a,b\n1,2\n",
        "# mocapbench baseline\ntask,case\nt,c\n",
        "# mocapbench baseline\ntask,version,case,label,metric,fold 0\nt,one,c,l,mse,1\n",
        "# mocapbench baseline\ntask,version,case,label,metric,fold 0\nt,1,c,l,mse,nan\n",
        "# mocapbench baseline\ntask,version,case,label,metric,fold 0\nt,1,c,l,mse,\n",
        "# mocapbench baseline\ntask,version,case,label,metric,fold x\nt,1,c,l,mse,1\n",
        "# mocapbench baseline\ntask,version,case,label,metric,fold 0\nt,1,c,l,mse,0.25,1\n",
        "# mocapbench baseline\ntask,version,case,label,metric,fold 0,fold 1\nt,1,c,l,mse,1\n",
        "# mocapbench baseline\ntask,version,case,label,metric,fold 0\nt,1,c,l,mse,0.2",
        "# mocapbench baseline\ntask,version,case,label,metric,fold 0\n" + 2 * "t,1,c,l,mse,1\n",
        "# mocapbench baseline\n# no colon\ntask,version,case,label,metric,fold 0\n",
    ],
)
def test_a_file_that_is_none_is_refused(tmp_path, text):
    (tmp_path / "b.csv").write_text(text)
    with pytest.raises(UsageError, match=r"b\.csv: expected reference values; .*--update"):
        read_reference(tmp_path)


def test_a_file_and_its_copy_do_not_belong_together(tmp_path):
    for name in ("one.csv", "copy.csv"):
        write_reference(tmp_path / name, Reference({_series(): {0: 1.0}}, ABOUT))
    with pytest.raises(UsageError, match="t, 1, c, l, mse has two rows; keep one"):
        read_reference(tmp_path)


def test_a_folder_may_be_called_like_a_file(tmp_path):
    path = tmp_path / "folder.csv"
    path.mkdir()
    reference = Reference({_series(): {0: 1.0}}, ABOUT)
    write_reference(path, reference)
    assert read_reference(path) == reference


def test_files_of_two_profiles_do_not_belong_together(tmp_path):
    for profile in ("smoke", "quick"):
        about = ABOUT | {"profile": profile}
        write_reference(
            tmp_path / f"{profile}.csv", Reference({_series(task=profile): {0: 1.0}}, about)
        )
    with pytest.raises(UsageError, match=r"expected one profile .* got quick and smoke"):
        read_reference(tmp_path)


def test_an_update_that_was_killed_midway_is_finished_before_the_values_are_read(tmp_path):
    new = Reference({_series(): {0: 2.0}}, ABOUT)
    write_reference(tmp_path / "folder", new)
    (written,) = (tmp_path / "folder").iterdir()
    left = tmp_path / "folder" / f"{PREFIX}reference"
    leave_lock(left)
    (left / "decided").mkdir(parents=True)
    (left / "obsolete").mkdir()
    written.rename(left / "decided" / written.name)
    (left / "obsolete" / "gone.csv").touch()
    (tmp_path / "folder" / "gone.csv").write_text("half of what was there before")
    assert read_reference(tmp_path / "folder").values == new.values
    assert [*(tmp_path / "folder").iterdir()] == [written]


def test_values_that_another_process_writes_are_not_written_meanwhile(tmp_path):
    values = Reference({_series(): {0: 1.0}}, ABOUT)
    with (
        write_together(tmp_path, "reference"),
        pytest.raises(BlockingIOError, match="another process"),
    ):
        write_reference(tmp_path / "b.csv", values)
