"""Small CSV files of smooth channels, for tests of task files."""

import numpy as np


def write_csv(path, n_frames=60, channels=("hip.x", "hip.y", "knee.x"), rate=50.0, gaps=()):
    """Write smooth channels; ``gaps`` are (start, stop, column)."""
    times = np.arange(n_frames) / rate
    values = np.sin(2 * np.pi * times[:, None] + np.arange(len(channels)))
    for start, stop, column in gaps:
        values[start:stop, column] = np.nan
    rows = [",".join(["time", *channels])]
    for time, row in zip(times, values, strict=True):
        cells = ("" if np.isnan(value) else f"{value:.6f}" for value in row)
        rows.append(",".join([f"{time:.4f}", *cells]))
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text("\n".join(rows) + "\n")
    return path
