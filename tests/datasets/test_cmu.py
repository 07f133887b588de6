"""The CMU library: folder before cache, cache before server, and only verified files."""

import os
import pickle
from hashlib import sha256

import numpy as np
import pytest
from c3d_files import write_bytes

from mocapbench.datasets import (
    CMU_ACKNOWLEDGEMENT,
    AcclaimError,
    CMULibrary,
    DigestMismatch,
    FetchError,
    SkeletonUnavailable,
    UnregisteredDigestWarning,
    registered_digests,
    subject_of,
)

ASF, AMC = "subjects/01/01.asf", "subjects/01/01_02.amc"


@pytest.fixture
def files(skeleton_text, motion_text):
    return {ASF: skeleton_text.encode(), AMC: motion_text.encode()}


@pytest.fixture
def known(files):
    return {path: sha256(content).hexdigest() for path, content in files.items()}


@pytest.fixture
def library(server, files, known, tmp_path):
    """A library with an empty folder and an empty cache before a server that has all files."""
    server.files = dict(files)
    return CMULibrary(
        tmp_path / "data",
        cache_dir=tmp_path / "cache",
        base_url=server.url,
        known=known,
        retries=1,
        backoff=0.0,
    )


def store(folder, files):
    for path, content in files.items():
        (folder / path).parent.mkdir(parents=True, exist_ok=True)
        (folder / path).write_bytes(content)


def test_reading_never_downloads(library, server):
    assert library.where("01_02") == ""
    with pytest.raises(FileNotFoundError, match=ASF):
        library.motion("01_02")
    assert not server.requests


def test_fetching_makes_it_readable(library, tmp_path):
    library.fetch("01_02")
    assert library.where("01_02") == str(tmp_path / "cache" / AMC)
    assert library.motion("01_02").values.shape == (3, 12)


def test_fetching_again_downloads_only_missing_files(library, server, files, known, tmp_path):
    library.fetch("01_02")
    server.files["subjects/01/01_03.amc"] = files[AMC]
    known["subjects/01/01_03.amc"] = known[AMC]
    server.requests.clear()
    library.fetch("01_02")
    library.fetch("01_03")
    assert dict(server.requests) == {"subjects/01/01_03.amc": 1}


def test_the_users_folder_comes_first_and_needs_no_server(library, server, files, tmp_path):
    library.fetch("01_02")
    store(tmp_path / "data", files)
    server.requests.clear()
    library.fetch("01_02")
    assert library.where("01_02") == str(tmp_path / "data" / AMC)
    assert not server.requests


def test_one_file_may_be_in_the_folder_and_the_other_in_the_cache(library, files, tmp_path):
    store(tmp_path / "data", {ASF: files[ASF]})
    store(tmp_path / "cache", {AMC: files[AMC]})
    assert library.motion("01_02").values.shape == (3, 12)


def test_several_folders_are_searched_in_order(known, files, tmp_path):
    one, two = tmp_path / "one", tmp_path / "two"
    library = CMULibrary(one, two, cache_dir=tmp_path / "cache", known=known)
    assert library.folders == (one, two)
    store(two, files)
    assert library.where("01_02") == str(two / AMC)
    store(one, {AMC: files[AMC]})
    assert library.where("01_02") == str(one / AMC)
    assert library.motion("01_02").values.shape == (3, 12)


def test_the_environment_may_name_several_folders(monkeypatch, known, files, tmp_path):
    store(tmp_path / "two", files)
    monkeypatch.setenv("MOCAPBENCH_DATA", f"{tmp_path / 'one'}{os.pathsep}{tmp_path / 'two'}")
    library = CMULibrary(cache_dir=tmp_path / "cache", known=known)
    assert library.where("01_02") == str(tmp_path / "two" / AMC)


def test_one_file_of_two_is_not_a_recording(library, files, tmp_path):
    store(tmp_path / "data", {AMC: files[AMC]})
    assert library.where("01_02") == ""


def test_the_digest_covers_both_files_and_ignores_line_ends(library, files, tmp_path):
    expected = sha256(files[ASF] + files[AMC]).hexdigest()
    store(tmp_path / "data", files)
    assert library.digest("01_02") == expected
    store(tmp_path / "data", {p: c.replace(b"\n", b"\r\n") for p, c in files.items()})
    assert library.digest("01_02") == expected
    np.testing.assert_array_equal(library.motion("01_02").values[0, :3], [1, 2, 3])


def test_a_wrong_download_is_refused_and_not_kept(library, server, known):
    server.files[AMC] += b"4\n"
    with pytest.raises(DigestMismatch, match=known[AMC]):
        library.fetch("01_02")
    assert library.where("01_02") == ""


def test_a_wrong_file_in_the_cache_is_refused_and_fetched_anew(library, files, tmp_path):
    store(tmp_path / "cache", {**files, AMC: b"damaged"})
    with pytest.raises(DigestMismatch, match="01_02"):
        library.motion("01_02")
    library.fetch("01_02")
    assert (tmp_path / "cache" / AMC).read_bytes() == files[AMC]


def test_a_wrong_file_in_the_users_folder_is_refused_and_left_alone(library, files, tmp_path):
    store(tmp_path / "data", {**files, AMC: b"mine"})
    with pytest.raises(DigestMismatch, match="data"):
        library.fetch("01_02")
    assert (tmp_path / "data" / AMC).read_bytes() == b"mine"


def test_without_a_registered_digest_the_first_one_is_pinned(library, known, files, tmp_path):
    del known[AMC]
    with pytest.warns(UnregisteredDigestWarning, match=AMC):
        library.fetch("01_02")
    assert library.motion("01_02").values.shape == (3, 12)
    store(tmp_path / "data", {AMC: files[AMC].replace(b"shin 42", b"shin 43")})
    with pytest.raises(DigestMismatch, match="data"):
        library.motion("01_02")


@pytest.mark.parametrize("page", [b"Please log in to this network", b"", b":FULLY-SPECIFIED\n"])
@pytest.mark.parametrize("wrong", [ASF, AMC])
def test_what_is_no_motion_is_neither_kept_nor_expected_from_then_on(
    library, server, files, page, wrong
):
    library.digests.known = {}
    server.files[wrong] = page
    with pytest.raises(FetchError, match="expected a skeleton and a motion"):
        library.fetch("01_02")
    assert library.where("01_02") == ""
    assert not library.digests.pins.exists()
    server.files[wrong] = files[wrong]
    with pytest.warns(UnregisteredDigestWarning):
        library.fetch("01_02")
    assert library.motion("01_02").values.shape == (3, 12)


def test_what_is_no_motion_in_the_users_folder_is_not_expected_and_left_alone(
    library, known, files, tmp_path
):
    known.clear()
    store(tmp_path / "data", {**files, AMC: b"nonsense\n"})
    with pytest.raises(AcclaimError, match="line 1: expected a header"):
        library.digest("01_02")
    with pytest.raises(FetchError, match="line 1: expected a header"):
        library.fetch("01_02")
    assert not library.digests.pins.exists()
    assert (tmp_path / "data" / AMC).exists()


def test_another_copy_is_taken_as_right_when_the_user_says_so(library, known, files, tmp_path):
    del known[AMC]
    with pytest.warns(UnregisteredDigestWarning):
        library.fetch("01_02")
    store(tmp_path / "data", {AMC: files[AMC].replace(b"shin 42", b"shin 43")})
    with pytest.raises(DigestMismatch, match="mocapbench data renew 01_02"):
        library.motion("01_02")
    with pytest.warns(UnregisteredDigestWarning, match=AMC):
        library.renew("01_02")
    assert library.motion("01_02").values[-1, -1] == 43


def test_a_registered_file_is_not_renewed(library, files, tmp_path):
    store(tmp_path / "data", {**files, AMC: b"mine"})
    with pytest.raises(DigestMismatch, match="data"):
        library.renew("01_02")


@pytest.mark.parametrize("trial", [13, 14, 19, 23, 24, 25, 26])
def test_of_a_recording_with_interpolated_copies_any_is_read(trial, server, known, files, tmp_path):
    key, asf, amc = f"35_{trial}", "subjects/35/35.asf", f"subjects/35/35_{trial}.amc"
    assert amc not in registered_digests()
    server.files = {asf: files[ASF], amc: files[AMC]}
    folder, cache = tmp_path / "data", tmp_path / "cache"
    library = CMULibrary(
        folder, cache_dir=cache, base_url=server.url, known={asf: known[ASF]}, retries=0
    )
    with pytest.warns(UnregisteredDigestWarning, match=f"{amc}; .*not pinned"):
        library.fetch(key)
    store(folder, {amc: files[AMC].replace(b"shin 42", b"shin 43")})
    with pytest.warns(UnregisteredDigestWarning, match=f"{amc}; .*not pinned"):
        assert library.motion(key).values[-1, -1] == 43


def test_a_file_that_the_server_lacks_is_an_error_and_keeps_the_rest(library, tmp_path):
    with pytest.raises(FetchError, match="404"):
        library.fetch("01_77")
    assert (tmp_path / "cache" / ASF).exists()


def test_a_right_but_unreadable_file_is_an_acclaim_error(library, known, files, tmp_path):
    known[AMC] = sha256(b"nonsense\n").hexdigest()
    store(tmp_path / "data", {**files, AMC: b"nonsense\n"})
    with pytest.raises(AcclaimError, match=r"01_02\.amc, line 1"):
        library.motion("01_02")


@pytest.mark.parametrize("key", ["", "35", "35_2", "../../etc_02", "35_02.amc", "cmu:35_02"])
def test_a_malformed_key_is_refused(library, key):
    with pytest.raises(ValueError, match="SUBJECT_TRIAL"):
        library.where(key)


def test_a_library_can_be_sent_to_another_process(library, files, tmp_path):
    store(tmp_path / "data", files)
    assert pickle.loads(pickle.dumps(library)).digest("01_02") == library.digest("01_02")


def test_the_acknowledgement_names_the_grant():
    assert "NSF EIA-0196217" in CMU_ACKNOWLEDGEMENT


MARKED = "subjects/01/01_02.c3d"
LABELS = ("LKNE", "LA\r\n", "LHEE", "LTOE")
PLACES = np.arange(24.0).reshape(2, 4, 3) + 1


@pytest.fixture
def markers(server, known, tmp_path):
    """Return the bytes of a file of markers that the server has, with CRLF among them."""
    data = write_bytes(tmp_path / "made.c3d", PLACES, labels=LABELS).read_bytes()
    assert b"\r\n" in data
    server.files[MARKED], known[MARKED] = data, sha256(data).hexdigest()
    return data


def test_markers_of_a_recording_are_one_file_beside_its_angles(library, markers, tmp_path):
    library.fetch("01_02.c3d")
    assert library.where("01_02.c3d") == str(tmp_path / "cache" / MARKED)
    recording = library.recording("01_02.c3d")
    assert recording.name == "01_02.c3d"
    assert (recording.channels[0], recording.units[0]) == ("LKNE.x", "mm")
    np.testing.assert_array_equal(recording.values, PLACES.reshape(2, 12))
    assert library.digest("01_02.c3d") == sha256(markers).hexdigest()
    assert library.where("01_02") == ""


def test_line_ends_in_a_file_of_numbers_are_numbers(library, markers, tmp_path):
    store(tmp_path / "data", {MARKED: markers.replace(b"\r\n", b"\n\n")})
    with pytest.raises(DigestMismatch, match=r"01_02\.c3d"):
        library.recording("01_02.c3d")


def test_markers_have_neither_a_skeleton_nor_angles(library, markers, tmp_path):
    store(tmp_path / "data", {MARKED: markers})
    for read in (library.skeleton, library.motion):
        with pytest.raises(SkeletonUnavailable, match=r"01_02\.c3d"):
            read("01_02.c3d")


def test_a_download_that_is_no_file_of_markers_is_not_kept(library, server, tmp_path):
    server.files[MARKED] = b"not found"
    with pytest.raises(FetchError, match="markers"):
        library.fetch("01_02.c3d")
    assert not (tmp_path / "cache" / MARKED).exists()


def test_the_subject_of_markers_is_that_of_the_recording():
    assert subject_of("cmu:135_02.c3d") == "135"
