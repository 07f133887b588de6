"""Memory: proportional to the text whatever it contains, and nothing of it is kept by an error."""

import gc
import io
import os
import tracemalloc
import warnings
from contextlib import suppress
from functools import partial
from threading import Thread

import pytest
from hypothesis import given
from hypothesis import strategies as st

from mocapbench.datasets import (
    AcclaimError,
    TruncatedFrameWarning,
    parse_skeleton,
    read_motion,
    read_skeleton,
)
from mocapbench.datasets.acclaim import motion_reader, skeleton_reader

SKELETON_FACTOR = 80
MOTION_FACTOR = 16
CONSTANT = 2**17 + io.DEFAULT_BUFFER_SIZE  # bytes: what does not depend on the text
KEPT = 2**14  # bytes
N = 20_000
NAMES = [f"{number:x}" for number in range(1000)]

HEAD = """\
:name nasty
:units
length 1
angle deg
:root
order TX TY TZ RX RY RZ
axis XYZ
position 0 0 0
orientation 0 0 0
"""


def bones(names):
    block = "begin\nname {}\ndirection 0 0 0\nlength 1\naxis 0 0 0 XYZ\ndof rx ry rz\nend\n"
    return ":bonedata\n" + "".join(map(block.format, names))


def hierarchy(lines):
    return ":hierarchy\nbegin\n" + "".join(f"{line}\n" for line in lines) + "end\n"


def flat(names):
    return HEAD + bones(names) + hierarchy(f"root {name}" for name in names)


def chain(names):
    pairs = zip(["root", *names], names, strict=False)
    return HEAD + bones(names) + hierarchy(f"{parent} {child}" for parent, child in pairs)


LONG_NAMES = [f"{'n' * 4000}{number}" for number in range(40)]
SMALL = flat(["a"])

READ_SKELETONS = {
    "many bones": flat(NAMES),
    "a deep hierarchy": chain(NAMES),
    "long names": flat(LONG_NAMES),
}
REFUSED_SKELETONS = {
    "bones without a place": HEAD + bones(NAMES) + hierarchy([]),
    "the same bone": HEAD + bones(["a"] * 1000) + hierarchy(["root a"]),
    "the same children": HEAD + bones(NAMES) + hierarchy(["root " + " ".join(NAMES[:800])] * 20),
    "empty blocks": HEAD + ":bonedata\n" + "begin\nend\n" * N + ":hierarchy\n",
    "blocks without an end": HEAD + ":bonedata\n" + "begin\n" * N + "end\n:hierarchy\n",
    "ends": HEAD + ":bonedata\n" + "end\n" * N + ":hierarchy\n",
    "joint limits": HEAD + ":bonedata\nbegin\n" + "(\n" * N + "end\n:hierarchy\n",
    "sections": HEAD + "".join(f":{number:x}\n" for number in range(N)),
    "short lines": HEAD + ":documentation\n" + "x\n" * N,
    "short lines, not Latin": HEAD + ":documentation\n" + "Ж\n" * N,
    "one wide character": HEAD + ":documentation\n" + "(\n" * N + "\U0001f600\n",
    "blank lines": HEAD + "\n" * 4 * N,
    "comments": HEAD + "#\n" * N,
    "thousands of digits": SMALL.replace("length 1\naxis", f"length {'9' * 4000}\naxis"),
    "a huge exponent": SMALL.replace("length 1\naxis", f"length 1e{'9' * 4000}\naxis"),
    "not UTF-8": flat(NAMES) + "\udcff",
    "larger than accepted": HEAD + ":documentation\n" + "x\n" * 2**19,
}


def motion(names=("a",), *, n_frames=1, first="1", number="1"):
    frame = f"root{f' {number}' * 6}\n" + "".join(f"{n}{f' {number}' * 3}\n" for n in names)
    later = "".join(f"{k}\n{frame}" for k in range(2, 1 + n_frames))
    return f":FULLY-SPECIFIED\n:DEGREES\n{first}\n{frame}{later}"


READ_MOTIONS = {
    "many frames": (SMALL, motion(n_frames=2000)),
    "many frames and a wide character": (SMALL, "#\U0001f600\n" + motion(n_frames=2000)),
    "many segments": (flat(NAMES), motion(NAMES, n_frames=3)),
    "long names": (flat(LONG_NAMES), motion(LONG_NAMES, n_frames=2)),
    "hundreds of digits": (SMALL, motion(number=f"0.{'1' * 500}", n_frames=100)),
    "blank lines": (SMALL, "\n" * 4 * N + motion()),
    "comments": (SMALL, "#\n" * N + motion()),
}
REFUSED_MOTIONS = {
    "many segments that lack": (flat(NAMES), motion()),
    "a gap of frames": (SMALL, motion() + "1000000000\nroot 1 1 1 1 1 1\na 1 1 1\n"),
    "a huge first frame": (SMALL, motion(first="9" * 18)),
    "thousands of digits": (SMALL, motion(first="9" * 4000)),
    "huge exponents": (SMALL, motion(number=f"1e{'9' * 500}", n_frames=100)),
    "frame numbers only": (SMALL, motion() + "1\n" * N),
    "many words": (SMALL, motion() + "2\n" + ("1 " * 2000 + "\n") * 50),
    "headers": (SMALL, ":DEGREES\n" * N),
    "blank lines without frames": (SMALL, "\n" * 4 * N + "x"),
    "comments without frames": (SMALL, "#\n" * N + "x"),
    "a wrong last line": (SMALL, motion(n_frames=2000) + "2001\nroot x\n"),
    "not UTF-8": (SMALL, motion(n_frames=2000) + "\udcff"),
}


@pytest.fixture
def path(tmp_path):
    return tmp_path / "nasty"


def write(path, text):
    """Write text, in which a lone surrogate stands for a byte that is not UTF-8."""
    data = text.encode(errors="surrogateescape")
    path.write_bytes(data)
    return len(data)


def kept_by_error(read, path):
    """Return the memory in bytes that the error of reading holds."""
    tracemalloc.start()
    try:
        read(path)
    except AcclaimError as problem:
        error = problem
    finally:
        gc.collect()
        held = tracemalloc.get_traced_memory()[0]
        tracemalloc.stop()
    assert str(error)
    return held


def peak(read, path):
    """Return the most memory that reading takes, in bytes, and the error if there is one."""
    error = None
    tracemalloc.start()
    try:
        read(path)
    except AcclaimError as problem:
        error = problem
    finally:
        most = tracemalloc.get_traced_memory()[1]
        tracemalloc.stop()
    return most, error


@pytest.mark.parametrize("text", READ_SKELETONS.values(), ids=READ_SKELETONS)
def test_a_skeleton_takes_memory_in_proportion_to_its_text(path, text):
    size = write(path, text)
    most, error = peak(read_skeleton, path)
    assert error is None
    assert most <= SKELETON_FACTOR * size + CONSTANT


@pytest.mark.parametrize("text", REFUSED_SKELETONS.values(), ids=REFUSED_SKELETONS)
def test_a_refused_skeleton_takes_no_more_and_its_error_keeps_nothing_of_it(path, text):
    size = write(path, text)
    most, error = peak(read_skeleton, path)
    assert error.file == str(path)
    assert most <= SKELETON_FACTOR * size + CONSTANT
    assert kept_by_error(read_skeleton, path) < KEPT


@pytest.mark.parametrize(("skeleton", "text"), READ_MOTIONS.values(), ids=READ_MOTIONS)
def test_a_motion_takes_memory_in_proportion_to_its_text(path, skeleton, text):
    read = partial(read_motion, skeleton=parse_skeleton(skeleton, ""))
    size = write(path, text)
    most, error = peak(read, path)
    assert error is None
    assert most <= MOTION_FACTOR * size + SKELETON_FACTOR * len(skeleton) + CONSTANT


@pytest.mark.parametrize(("skeleton", "text"), REFUSED_MOTIONS.values(), ids=REFUSED_MOTIONS)
def test_a_refused_motion_takes_no_more_and_its_error_keeps_nothing_of_it(path, skeleton, text):
    read = partial(read_motion, skeleton=parse_skeleton(skeleton, ""))
    size = write(path, text)
    most, error = peak(read, path)
    assert error.file == str(path)
    assert most <= MOTION_FACTOR * size + SKELETON_FACTOR * len(skeleton) + CONSTANT
    assert kept_by_error(read, path) < KEPT


def small_mutations(data, mutated, rng):
    """Return mutated bytes in which one piece may be repeated many times."""
    data = mutated(data, rng)
    at = rng.randrange(len(data) + 1)
    piece = data[at : at + rng.choice([1, 2, 5, 60])]
    return data[:at] + piece * rng.choice([0, 1, 100, 1000]) + data[at:]


@given(st.randoms(use_true_random=False))
def test_no_mutated_skeleton_takes_more(tmp_path_factory, skeleton_text, mutated, rng):
    path = tmp_path_factory.mktemp("memory") / "mutated.asf"
    path.write_bytes(small_mutations(skeleton_text.encode(), mutated, rng))
    most, _ = peak(read_skeleton, path)
    assert most <= SKELETON_FACTOR * path.stat().st_size + CONSTANT


@given(st.randoms(use_true_random=False))
def test_no_mutated_motion_takes_more(tmp_path_factory, skeleton, motion_text, mutated, rng):
    path = tmp_path_factory.mktemp("memory") / "mutated.amc"
    path.write_bytes(small_mutations(motion_text.encode(), mutated, rng))
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", TruncatedFrameWarning)
        most, _ = peak(partial(read_motion, skeleton=skeleton), path)
    assert most <= MOTION_FACTOR * path.stat().st_size + CONSTANT


@pytest.mark.parametrize(
    ("reader", "read"),
    [(skeleton_reader, read_skeleton), (motion_reader, partial(read_motion, skeleton=None))],
)
def test_a_stream_without_end_is_refused(monkeypatch, tmp_path, reader, read):
    monkeypatch.setattr(reader, "_MAX_BYTES", 2**20)
    path = tmp_path / "endless"
    os.mkfifo(path)
    thread = Thread(target=pour, args=(path,))
    thread.start()
    most, error = peak(read, path)
    thread.join()
    assert error.expected == "a file of at most 1 MiB"
    assert most < 2**22


def pour(path):
    """Write 64 MiB of short lines, or as many as somebody reads."""
    with suppress(BrokenPipeError), path.open("wb", buffering=0) as stream:
        for _ in range(2**14):
            stream.write(b"#\n" * 2**11)
