"""C3D files by the rules of the format: of any computer, and with header and parameters that err.

Written without the code that is tested: DEC numbers are IEEE numbers times 4 with words swapped.
"""

import struct

import numpy as np

PROCESSORS = {"Intel": 84, "DEC": 85, "MIPS": 86}
N_ANALOGUE, EACH = 3, 2  # channels, and samples of each in a frame


def floats(computer, values):
    """Return the bytes of floating-point numbers."""
    order = ">" if computer == "MIPS" else "<"
    stored = (np.atleast_1d(np.float64(values)) * (4 if computer == "DEC" else 1)).astype(
        f"{order}f4"
    )
    words = np.frombuffer(stored.tobytes(), "<u2").reshape(-1, 2)
    return (words[:, ::-1] if computer == "DEC" else words).tobytes()


def words(computer, *values):
    """Return the bytes of 16-bit words."""
    return np.array(values).astype(">u2" if computer == "MIPS" else "<u2").tobytes()


def text(*texts, width=8):
    """Return a parameter of texts, padded with blanks."""
    data = "".join(one.ljust(width) for one in texts).encode()
    return -1, [width, len(texts)], data


def word(computer, *values):
    """Return a parameter of words: one, or some."""
    return 2, [] if len(values) == 1 else [len(values)], words(computer, *values)


def number(computer, *values):
    """Return a parameter of floating-point numbers."""
    return 4, [] if len(values) == 1 else [len(values)], floats(computer, values)


def parameters_of(computer, shape, scale, rate, labels):
    """Return the parameters of a file that errs in nothing."""
    n_frames, n_points = shape
    return {
        "POINT:USED": word(computer, n_points),
        "POINT:FRAMES": word(computer, min(n_frames, 65535)),
        "POINT:SCALE": number(computer, scale),
        "POINT:RATE": number(computer, rate),
        "POINT:DATA_START": word(computer, 0),  # put in last
        "POINT:UNITS": (-1, [2], b"mm"),
        "POINT:LABELS": text(*labels),
        "POINT:DESCRIPTIONS": text(*labels),
        "ANALOG:USED": word(computer, N_ANALOGUE),
        "ANALOG:RATE": number(computer, rate * EACH),
        "ANALOG:GEN_SCALE": number(computer, 1.0),
        "ANALOG:SCALE": number(computer, *[1.0] * N_ANALOGUE),
        "ANALOG:OFFSET": word(computer, *[0] * N_ANALOGUE),
        "ANALOG:UNITS": text(*["V"] * N_ANALOGUE),
        "ANALOG:LABELS": text("EMG1", "EMG2", "EMG3"),
        "ANALOG:DESCRIPTIONS": text("EMG1", "EMG2", "EMG3"),
        "FORCE_PLATFORM:USED": word(computer, 0),
    }


def section(computer, parameters):
    """Return the bytes of a parameter section, of whole blocks."""
    groups = list(dict.fromkeys(name.partition(":")[0] for name in parameters))
    records = [(-k - 1, group, b"\0") for k, group in enumerate(groups)]
    for name, (kind, dimensions, data) in parameters.items():
        group, _, bare = name.partition(":")
        content = struct.pack("bB", kind, len(dimensions)) + bytes(dimensions) + data + b"\0"
        records.append((groups.index(group) + 1, bare, content))
    body = b"".join(
        struct.pack("bb", len(name), group) + name.encode() + words(computer, 2 + len(rest)) + rest
        for group, name, rest in records
    )
    body += b"\0\0"
    blocks = -(-(len(body) + 4) // 512)
    return (bytes([1, 0x50, blocks, PROCESSORS[computer]]) + body).ljust(512 * blocks, b"\0")


def frames_of(computer, values, scale, analogue):
    """Return the bytes of all frames; hidden points are at the origin with the residual −1."""
    hidden = np.isnan(values).any(axis=2, keepdims=True)
    points = np.concatenate(
        [
            np.where(hidden, 0.0, values / (scale if scale > 0 else 1)),
            np.where(hidden, -1.0, 2.0),
        ],
        axis=2,
    )
    numbers = np.hstack([points.reshape(len(values), -1), analogue])
    if scale > 0:
        return words(computer, *np.round(numbers).astype(int).ravel() % 65536)
    return floats(computer, numbers.ravel())


def write_bytes(
    path,
    values,
    computer="Intel",
    scale=-1.0,
    *,
    labels=None,
    rate=100.0,
    first=1,
    parameter_block=2,
    between=0,
    pad=True,
    header=(),
    parameters=(),
):
    """Write positions (N, points, 3), NaN where hidden, with three analogue channels.

    ``header`` gives words by number, ``parameters`` parameters by name, or None to leave one out;
    ``between`` is how many blocks of 0xFF stand between parameters and data.
    """
    n_frames, n_points = values.shape[:2]
    labels = [f"M{k:02}" for k in range(n_points)] if labels is None else labels
    made = parameters_of(computer, (n_frames, n_points), scale, rate, labels) | dict(parameters)
    made = {name: value for name, value in made.items() if value is not None}
    blocks = len(section(computer, made)) // 512
    data_block = parameter_block + blocks + between
    if made.get("POINT:DATA_START") == word(computer, 0):
        made["POINT:DATA_START"] = word(computer, data_block)
    head = bytearray(512)
    head[12:16], head[20:24] = floats(computer, scale), floats(computer, rate)
    stated = {
        2: n_points,
        3: N_ANALOGUE * EACH,
        4: first,
        5: min(first + n_frames - 1, 65535),
        9: data_block,
        10: EACH,
    } | dict(header)
    for place, value in stated.items():
        head[2 * place - 2 : 2 * place] = words(computer, value)
    head[:2] = bytes([parameter_block, 0x50])
    analogue = np.arange(n_frames * N_ANALOGUE * EACH).reshape(n_frames, -1) % 2000
    data = frames_of(computer, values, scale, analogue)
    data = data.ljust(-(-len(data) // 512) * 512, b"\0") if pad else data
    filler = b"\xff" * 512
    path.write_bytes(
        bytes(head)
        + filler * (parameter_block - 2)
        + section(computer, made)
        + filler * between
        + data
    )
    return path
