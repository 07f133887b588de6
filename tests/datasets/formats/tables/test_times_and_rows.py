"""Times by any usual name and unit, rows that are missing, and rows of several markers a frame."""

import warnings

import numpy as np
import pytest
from vendor_tables import N, long_rows, motive, nexus, opensim, sleap

from mocapbench.datasets import CSVFormat, FormatError, FormatWarning, frame_rate

CSV = CSVFormat()
INSERTING = CSV.with_missing_rows()


@pytest.fixture
def read(tmp_path):
    """Return a function that reads a text as a table."""

    def read(text, rate=None, kind=CSV):
        (tmp_path / "walk.csv").write_text(text, encoding="utf-8", newline="")
        return kind.read(tmp_path / "walk.csv", rate)

    return read


def steps(name, step, start=0.0, n=6):
    rows = [f"{start + k * step:.15g},{k}.5" for k in range(n)]
    return "\n".join([f"{name},hip", *rows, ""])


@pytest.mark.parametrize(
    ("name", "step", "start"),
    [
        *[(name, 0.01, 0.0) for name in ("Time (Seconds)", "time_s", "timestamp", "Time", "t")],
        *[
            (name, 0.01, 7.5)
            for name in ("TIME [s]", "Time Stamp", "elapsed_time", "seconds", "Tiempo")
        ],
        ("timestamp", 0.01, 1.7e9),
        *[(name, 10.0, 0.0) for name in ("time_ms", "Time (ms)", "timestamp [msec]")],
        ("time_ms", 0.5, 0.0),
        ("timestamp_us", 10_000.0, 1e6),
        ("time [µs]", 10_000.0, 0.0),
        ("timestamp_ns", 1e7, 0.0),
    ],
)
def test_a_column_of_times_is_known_by_its_name_and_unit(read, name, step, start):
    rate = 2000.0 if step == 0.5 else 100.0
    with warnings.catch_warnings(action="error"):
        walk = read(steps(name, step, start))
    assert walk.channels == ("hip",)
    assert frame_rate(walk) == pytest.approx(rate, rel=1e-4)


@pytest.mark.parametrize(("step", "unit"), [(10.0, "milli"), (1e4, "micro"), (1e7, "nano")])
@pytest.mark.parametrize("name", ["time", "timestamp"])
def test_steps_tell_the_unit_of_times_with_a_word(read, name, step, unit):
    with pytest.warns(
        FormatWarning, match=rf"steps of times are 1.*0.*, .* for {unit}seconds; name"
    ):
        assert frame_rate(read(steps(name, step))) == pytest.approx(100.0)


@pytest.mark.parametrize(
    "name", ["stance_time", "tempo", "timing", "times two", "T1", "time to go"]
)
def test_other_columns_are_channels(read, name):
    assert read(steps(name, 0.01), rate=100.0).channels == (name, "hip")


def test_of_two_columns_of_times_the_first_counts_and_none_is_a_channel(read):
    walk = read("time,timestamp,hip\n0,1700000000,1\n0.5,1700000001,2\n")
    assert (walk.channels, walk.times.tolist()) == (("hip",), [0.0, 0.5])


def test_times_that_disagree_with_the_head_are_taken_with_a_word(tmp_path):
    path = tmp_path / "take.csv"
    text = motive().text.replace("Export Frame Rate,100.000000", "Export Frame Rate,25.000000")
    path.write_text(text, newline="")
    with pytest.warns(
        FormatWarning, match="expected 25 frames per second, .* got 100 by its times"
    ):
        assert frame_rate(CSV.read(path)) == pytest.approx(100.0)


@pytest.mark.parametrize("digits", [2, 3])
def test_rounded_times_agree_with_the_head(tmp_path, digits):
    table, path = motive(), tmp_path / "take.csv"
    text = table.text.replace("100.000000", "120.000000")
    for k in range(N):
        text = text.replace(f"\n{k},{k / 100:.6f},", f"\n{k},{k / 120:.{digits + 1}f},")
    path.write_text(text, newline="")
    with warnings.catch_warnings(action="error"):
        CSV.read(path)


CLOCKS = {
    "ISO": "2026-01-31T{h:02}:{m:02}:{s:06.3f}",
    "ISO, of a zone": "2026-01-31 {h:02}:{m:02}:{s:09.6f}+01:00",
    "ISO, UTC": "2026-01-31T{h:02}:{m:02}:{s:06.3f}Z",
    "ISO, of a named zone": "2026-01-31T{h:02}:{m:02}:{s:06.3f}+01:00[Europe/Vienna]",
    "MATLAB": "31-Jan-2026 {h:02}:{m:02}:{s:06.3f}",
    "a zone": "31/01/2026 {h:02}:{m:02}:{s:06.3f} CET",
    "German": "31.01.2026 {h:02}:{m:02}:{s:06.3f}",
    "a clock": "{h}:{m:02}:{s:06.3f}",
    "minutes": "{m:02}:{s:06.3f}",
}


def clock(form, start, n=8):
    """Return rows of a time and a number, 100 a second."""
    seconds = [start + k / 100 for k in range(n)]
    times = [
        form.format(h=int(t // 3600) % 24, m=int(t // 60) % 60, s=t % 60 + 1e-9) for t in seconds
    ]
    return [f"{time},{k}.5" for k, time in enumerate(times)]


@pytest.mark.parametrize("start", [0.25, 36059.96, 86399.96])
@pytest.mark.parametrize("form", CLOCKS)
def test_a_clock_tells_times_also_past_midnight(read, form, start):
    if form == "minutes" and start > 3600:
        pytest.skip("no hours")
    rows = clock(CLOCKS[form], start)
    walk = read("\n".join(["time,hip", *rows, ""]))
    assert walk.channels == ("hip",)
    np.testing.assert_allclose(np.diff(walk.times), 0.01, atol=1e-6)


@pytest.mark.parametrize("form", CLOCKS)
def test_rows_that_are_added_have_the_time_of_a_clock(read, tmp_path, form):
    rows = clock(CLOCKS[form], 59.95)
    walk = read("\n".join(["time,hip", *rows[:4], *rows[6:], ""]), kind=INSERTING)
    INSERTING.write(tmp_path / "out.csv", walk, tmp_path / "walk.csv")
    written = (tmp_path / "out.csv").read_text().splitlines()[1:]
    assert [row.split(",")[0] for row in written] == [row.split(",")[0] for row in rows]


@pytest.mark.parametrize(
    "name", ["datetime", "Date_Time", "date time", "timestamp_utc", "UTC time", "DateTime (UTC)"]
)
def test_a_column_of_dates_and_times_is_known_by_its_name(read, name):
    walk = read("\n".join([f"{name},hip", *clock(CLOCKS["ISO"], 59.95), ""]))
    assert walk.channels == ("hip",)
    np.testing.assert_allclose(np.diff(walk.times), 0.01, atol=1e-6)


def test_milliseconds_may_stand_behind_a_colon(read, tmp_path):
    rows = [row.replace(".", ":", 1) for row in clock(CLOCKS["a clock"], 59.95)]
    walk = read("\n".join(["time,hip", *rows[:4], *rows[6:], ""]), kind=INSERTING)
    np.testing.assert_allclose(np.diff(walk.times), 0.01, atol=1e-6)
    INSERTING.write(tmp_path / "out.csv", walk, tmp_path / "walk.csv")
    written = (tmp_path / "out.csv").read_text().splitlines()[1:]
    assert [row.split(",")[0] for row in written] == [row.split(",")[0] for row in rows]


def test_a_clock_knows_noon(read):
    walk = read("time,hip\n11:59:59.5 AM,1\n12:00:00.0 PM,2\n12:00:00.5 PM,3\n")
    np.testing.assert_allclose(np.diff(walk.times), 0.5)


def test_a_word_among_times_of_a_clock_is_named(read):
    rows = clock(CLOCKS["ISO"], 0.0)
    with pytest.raises(FormatError, match=r"line 4: expected a time .* got 'soon'; correct"):
        read("\n".join(["time,hip", *rows[:2], "soon,1", *rows[3:], ""]))


# Rows that are missing


def without(text, *frames):
    lines = text.splitlines(keepends=True)
    return "".join(line for line in lines if not line.startswith(tuple(f"{k}," for k in frames)))


ROWS = "\n".join(
    ["frame,time,hip,note", *(f"{k},{k / 100:.3f},{k}.50,n{k}" for k in range(12)), ""]
)


@pytest.mark.filterwarnings("ignore:.*left out")
@pytest.mark.parametrize("columns", [slice(0, 4), slice(1, 4), (0, 2, 3)])
def test_rows_that_are_missing_are_said_by_frames_or_times(read, columns):
    rows = np.array([line.split(",") for line in without(ROWS, 4, 5, 9).splitlines()])
    text = "\n".join(",".join(row) for row in rows[:, columns]) + "\n"
    rate = 100.0 if columns == (0, 2, 3) else None
    with pytest.warns(
        FormatWarning, match=r"3 rows are missing, behind line 5 and once later, by "
    ):
        walk = read(text, rate)
    assert np.flatnonzero(np.diff(walk.times) > 0.015).tolist() == [3, 6]
    with warnings.catch_warnings(action="ignore"):
        whole = read(text, rate, INSERTING)
    np.testing.assert_allclose(whole.times, np.arange(12) / 100)
    assert (~whole.visible).ravel().nonzero()[0].tolist() == [4, 5, 9]


@pytest.mark.filterwarnings("ignore:.*left out")
@pytest.mark.parametrize("end", ["\n", "\r\n"])
def test_rows_that_are_added_look_like_those_that_are_there(read, tmp_path, end):
    text = without(ROWS, 4, 5).replace("\n", end)
    walk = read(text, kind=INSERTING)
    filled = walk.with_values(np.where(walk.visible, walk.values, 7.25))
    INSERTING.write(tmp_path / "out.csv", filled, tmp_path / "walk.csv")
    added = [f"{k},{k / 100:.3f},7.25,{end}" for k in (4, 5)]
    lines = text.splitlines(keepends=True)
    expected = "".join([*lines[:5], *added, *lines[5:]])
    assert (tmp_path / "out.csv").read_bytes().decode() == expected


@pytest.mark.parametrize("make", [motive, nexus])
def test_missing_rows_of_programs_are_added_too(tmp_path, make):
    table, path = make(), tmp_path / "take.csv"
    path.write_text(without(table.text, 20, 21), newline="")
    with pytest.warns(FormatWarning, match="2 rows are missing, behind line "):
        assert len(CSV.load(path, None).times) == N - 2
    with warnings.catch_warnings(action="ignore"):  # the head has another count of rows
        walk = INSERTING.load(path, None)
        filled = walk.with_values(np.where(walk.visible, walk.values, table.values))
        INSERTING.write(tmp_path / "out.csv", filled, path)
        again = CSV.load(tmp_path / "out.csv", None)
    assert len(again.times) == N
    hidden = np.isnan(table.values)
    np.testing.assert_array_equal(again.values[~hidden], table.values[~hidden])
    before = path.read_bytes().splitlines()
    assert [line for line in (tmp_path / "out.csv").read_bytes().splitlines() if line in before]
    assert {*before} <= {*(tmp_path / "out.csv").read_bytes().splitlines()}


@pytest.mark.filterwarnings("ignore:.*left out")
def test_rows_are_added_also_where_nothing_is_filled(read, tmp_path):
    walk = read(without(ROWS, 4, 5), kind=INSERTING)
    none = np.zeros(walk.values.shape, dtype=bool)
    INSERTING.write(tmp_path / "out.csv", walk, tmp_path / "walk.csv", none)
    out = (tmp_path / "out.csv").read_text().splitlines()
    assert out[5:7] == ["4,0.040,,", "5,0.050,,"]


def test_rows_between_blanks_are_added_with_a_word_for_what_is_missing(tmp_path):
    table, path = opensim(" "), tmp_path / "ik.mot"
    lines = table.text.splitlines(keepends=True)
    path.write_text("".join(lines[:30] + lines[31:]))
    with warnings.catch_warnings(action="ignore"):  # the head has another count of rows
        walk = INSERTING.load(path, None)
        INSERTING.write(tmp_path / "out.mot", walk, path, np.zeros(walk.values.shape, dtype=bool))
        again = CSV.load(tmp_path / "out.mot", None)
    np.testing.assert_allclose(again.times, np.arange(N) / 100)
    assert np.isnan(again.values[20]).all()


def test_uneven_times_are_no_missing_rows(read):
    times = np.cumsum(np.random.default_rng(0).exponential(0.03, 50))
    text = "\n".join(["timestamp,hip", *(f"{time:.6f},1" for time in times)])
    with warnings.catch_warnings(action="error"):
        read(text)


def test_every_other_frame_is_no_missing_row(read):
    text = "\n".join(["frame,hip", *(f"{k},1" for k in range(0, 40, 2))])
    with warnings.catch_warnings(action="error"):
        walk = read(text, rate=50.0)
    np.testing.assert_allclose(walk.times, np.arange(20) / 50)


def test_so_many_rows_are_not_added_that_a_number_is_wrong(read):
    text = "\n".join(["frame,hip", "1,1", "2,1", "3,1", "4000000,1", ""])
    with pytest.raises(FormatError, match=r"line 5: .* rows or fewer to insert, got .*; correct"):
        read(text, 100.0, INSERTING)


# Rows of several markers a frame


def test_a_row_that_a_long_table_lacks_is_hidden_and_is_added_where_it_is_filled(read, tmp_path):
    table = long_rows(likely=False)
    lines = table.text.splitlines(keepends=True)
    text = "".join(line for line in lines if not line.startswith(("7,0.07,LKNE", "39,0.39,LANK")))
    walk = read(text)
    assert walk.channels == table.channels
    assert not walk.visible[7, 6:9].any()
    filled = walk.with_values(np.where(walk.visible, walk.values, 7.25))
    CSV.write(tmp_path / "out.csv", filled, tmp_path / "walk.csv")
    out = (tmp_path / "out.csv").read_text().splitlines()
    assert len(out) == len(lines)
    assert out[36:39] == [lines[36][:-1], lines[37][:-1], "7,0.07,LKNE,7.25,7.25,7.25"] or (
        "7,0.07,LKNE,7.25,7.25,7.25" in out
    )
    assert out[-1] == "39,0.39,LANK,7.25,7.25,7.25"
    assert {line.rstrip("\n") for line in lines if ",," not in line} - {*out} == {
        line.rstrip("\n") for line in lines if line.startswith(("7,0.07,LKNE", "39,0.39,LANK"))
    }


def test_rows_may_be_in_any_order(read):
    head, *rows = long_rows().text.splitlines()
    sorted_by_marker = sorted(rows, key=lambda row: row.split(",")[2])
    one = read(long_rows().text)
    two = read("\n".join([head, *sorted_by_marker, ""])).select(one.channels)
    np.testing.assert_array_equal(one.values, two.values)


@pytest.mark.parametrize(
    ("text", "complaint"),
    [
        (
            "frame,x,y\n0,1,2\n0,3,4\n1,5,6\n",
            r"line 3: .* got 0 again, after line 2; split a table",
        ),
        (
            "frame,keypoint,x\n0,a,2\n0,a,4\n1,a,6\n",
            r"line 3: expected one row for each frame, .* got 0 again, after line 2; split a table",
        ),
        (
            "frame,keypoint,x\n0,a,2\n,b,4\n0,b,6\n",
            r"line 3: expected a frame or time in every row",
        ),
        (
            "keypoint,x\na,2\nb,4\na,6\nb,1\n",
            r"a column 'frame' in a table .* none beside 'keypoint'",
        ),
    ],
)
@pytest.mark.filterwarnings("ignore:.*left out")
def test_rows_that_nothing_tells_apart_are_refused(read, text, complaint):
    with pytest.raises(FormatError, match=complaint):
        read(text, rate=100.0)


@pytest.mark.filterwarnings("ignore:.*left out")
def test_a_rate_takes_the_place_of_times_that_were_rounded(read):
    assert len(read("time,hip,note\n0,1,a\n0,2,a\n0.1,3,b\n", rate=60.0).times) == 3


@pytest.mark.filterwarnings("ignore:.*left out")
def test_samples_within_a_frame_are_frames_if_their_times_rise(read):
    walk = read("frame,time,side,hip\n0,0,a,1\n0,0.1,b,2\n1,0.2,a,3\n1,0.3,b,4\n")
    assert walk.channels == ("hip",)
    assert walk.times.tolist() == [0.0, 0.1, 0.2, 0.3]


@pytest.mark.parametrize("track", ["", "7", "track_0"])
@pytest.mark.filterwarnings("ignore:.*left out")
def test_a_marker_or_person_that_is_the_same_in_all_rows_is_no_channel(read, track):
    text = "\n".join(["track,frame_idx,nose.x", *(f"{track},{k},{k}.5" for k in range(4)), ""])
    assert read(text, 30.0).channels == ("nose.x",)


def test_notes_that_differ_in_each_row_tell_no_markers_apart(read):
    rows = [f"{k // 2},n{k},1.5" for k in range(2000)]
    with pytest.raises(FormatError, match="line 3: expected one row for each frame"):
        read("\n".join(["frame,note,x", *rows, ""]), 30.0)


# Likelihoods


@pytest.mark.parametrize(
    "text",
    [
        "frame,nose_x,nose_y,nose_likelihood,hip\n0,1,2,0.5,3\n1,1,2,0.25,3\n",
        "frame,x0,y0,v0,hip\n0,1,2,0.5,3\n1,1,2,0.25,3\n",
        "frame,nose.x,nose.y,nose.score,hip\n0,1,2,0.5,3\n1,1,2,0.25,3\n",
        "frame,x,y,visibility,hip\n0,1,2,0.5,3\n1,1,2,0.25,3\n",
    ],
)
def test_likelihoods_are_of_the_coordinates_beside_them(read, tmp_path, text):
    assert len(read(text, 100.0).channels) == 3
    likelihoods = CSV.likelihoods(tmp_path / "walk.csv")
    expected = [[0.5, 0.5, np.nan], [0.25, 0.25, np.nan]]
    np.testing.assert_array_equal(likelihoods, expected)


def test_a_score_beside_no_coordinates_is_a_channel(read, tmp_path):
    assert read("time,hip,score\n0,1,2\n0.1,1,2\n").channels == ("hip", "score")
    assert CSV.likelihoods(tmp_path / "walk.csv") is None


@pytest.mark.parametrize("table", [long_rows(), sleap()], ids=lambda table: table.name)
def test_likelihoods_of_rows_are_those_of_their_markers(tmp_path, table):
    path = tmp_path / table.name
    path.write_text(table.text, newline="")
    likelihoods = CSV.likelihoods(path)
    assert likelihoods.shape == table.values.shape
    low = np.argwhere(likelihoods < 0.5).tolist()
    assert low == ([[k, c] for k in (20, 21) for c in range(3)] if "long" in table.name else [])


def test_of_several_likelihoods_the_first_counts_and_none_is_a_channel(read, tmp_path):
    walk = read("frame,nose_x,nose_visibility,nose_presence\n0,1,0.5,0.9\n1,2,0.5,0.9\n", 30.0)
    assert walk.channels == ("nose_x",)
    np.testing.assert_array_equal(CSV.likelihoods(tmp_path / "walk.csv"), [[0.5], [0.5]])


@pytest.mark.parametrize(
    "name", ["reprojection_error", "nose_error", "nose_ncams", "instance.score"]
)
def test_what_says_how_well_a_point_was_found_is_no_channel(read, name):
    assert read(f"nose_x,{name}\n1,0.5\n2,0.5\n", 30.0).channels == ("nose_x",)


def test_of_numbers_and_names_of_markers_the_names_tell_rows_apart(read, tmp_path):
    """What else all rows of a marker share is no channel, and stands in rows that are added."""
    rows = [f"{k},{m},{name},Ann,{k}.5" for k in range(4) for m, name in ((0, "A"), (1, "B"))]
    del rows[3]
    walk = read("\n".join(["frame,landmark_id,landmark_name,person,x", *rows, ""]), 30.0)
    assert walk.channels == ("A.x", "B.x")
    filled = walk.with_values(np.where(walk.visible, walk.values, 7.25))
    CSV.write(tmp_path / "out.csv", filled, tmp_path / "walk.csv")
    assert "1,1,B,Ann,7.25" in (tmp_path / "out.csv").read_text().splitlines()


def test_anipose_counts_its_frames_as_fnum(read):
    assert read("nose_x,fnum\n1,7\n2,8\n", 30.0).channels == ("nose_x",)


@pytest.mark.parametrize(
    "text",
    [
        "hip,knee\n1,2\n3,4\n5,6\n",
        "frame,hip\n0,1\n,2\n5,3\n",
        "time,hip\n0,1\n0.3,2\n0.1,3\n0.2,4\n",
    ],
)
def test_where_nothing_counts_frames_no_row_is_missing(read, text):
    with warnings.catch_warnings(action="error"):
        assert len(read(text, 100.0, INSERTING).times) == text.count("\n") - 1


def test_rows_that_are_added_to_groups_with_times_of_their_own_are_read_again(read, tmp_path):
    rows = [f"{k / 100},{k}.5,{k / 100},{k}.25" for k in range(9) if k != 4]
    walk = read("\n".join(["Tiempo,a::Y,Tiempo,b::Y", *rows, ""]), kind=INSERTING)
    INSERTING.write(
        tmp_path / "out.csv", walk.with_values(np.nan_to_num(walk.values)), tmp_path / "walk.csv"
    )
    assert CSV.read(tmp_path / "out.csv").channels == walk.channels == ("a::Y", "b::Y")
