"""A small skeleton, real recordings if there are any, and a server on the loopback interface."""

import os
import threading
import time
from collections import Counter
from contextlib import suppress
from functools import partial
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path

import pytest

from mocapbench.datasets import open_archive, parse_skeleton

SKELETON = """\
# a leg and an arm
:version 1.10
:name TOY
:units
  mass 1.0
  length 0.5
  angle deg
:documentation
   anything at all
:root
   order TX TY TZ RX RY RZ
   axis XYZ
   position 0 0 0
   orientation 0 0 0
:bonedata
  begin
     id 1
     name hip
     direction 1 0 0
     length 2
     axis 0 0 0 XYZ
  end
  begin
     id 2
     name thigh
     direction 0 -1 0
     length 7.5
     axis 0 0 20 XYZ
     dof rx ry rz
     limits (-160.0 20.0)
            (-70.0 70.0)
            (-60.0 70.0)
  end
  begin
     id 3
     name shin
     direction 0 -1 0
     length 7
     axis 0 0 20 XYZ
     dof rx
     limits (-10.0 170.0)
  end
  begin
     id 4
     name arm
     direction 0.6 0.8 0
     length 5
     axis 180 30 -90 XYZ
     dof ry rz
  end
:hierarchy
  begin
    root hip arm
    hip thigh
    thigh shin
  end
"""

MOTION = """\
# a capture
:FULLY-SPECIFIED
:DEGREES
1
root 1 2 3 10 20 30
thigh -20 5 1
arm 15 -75
shin 40
2
root 1.5 2 3.5 11 21 31
thigh -2.1e1 5.5 1e-15
arm 16 -7.5e+001
shin 41
3
root 2 2 4 12 22 32
thigh -22 6 -1.5
arm 17 -77
shin 42
"""


@pytest.fixture(scope="session")
def skeleton_text():
    return SKELETON


@pytest.fixture(scope="session")
def motion_text():
    return MOTION


@pytest.fixture(scope="session")
def skeleton():
    return parse_skeleton(SKELETON, "toy.asf")


@pytest.fixture(scope="session")
def mutated():
    """Return a function that replaces, inserts, removes or repeats pieces of some bytes."""

    def mutate(data, rng):
        for _ in range(rng.randint(1, 8)):
            at, length = rng.randrange(len(data) + 1), rng.choice([0, 1, 2, 30])
            pieces = [b"", b"\n", b" ", b"\xff", b"\x1c", b"nan", b"-", b"_", b"1e999", b"begin\n"]
            pieces.append(data[at : at + 40])
            data = data[:at] + rng.choice(pieces) + data[at + length :]
        return data

    return mutate


@pytest.fixture(scope="session")
def data_dir():
    """The first folder of real recordings that is named."""
    folders = os.environ.get("MOCAPBENCH_DATA")
    if not folders:
        pytest.skip("MOCAPBENCH_DATA does not name a folder of real recordings")
    return Path(folders.split(os.pathsep)[0])


@pytest.fixture(scope="session")
def cmu(data_dir, tmp_path_factory):
    """The archive of real recordings."""
    return open_archive(data_dir, cache_dir=tmp_path_factory.mktemp("cache"))


class Tree(BaseHTTPRequestHandler):
    """Serves a dictionary of files and counts the requests."""

    def __init__(self, server_state, *arguments):
        self.state = server_state
        super().__init__(*arguments)

    def do_GET(self):
        path = self.path.lstrip("/")
        self.state.requests[path] += 1
        if self.state.failures:
            self.send_error(self.state.failures.pop())
        elif path not in self.state.files:
            self.send_error(404)
        else:
            self.send_response(200)
            self.send_header("Content-Type", self.state.content_type)
            for name, value in self.state.headers.items():
                self.send_header(name, value)
            self.end_headers()
            self._send(self.state.files[path])

    def _send(self, content):
        if not self.state.pause:
            self.wfile.write(content)
            return
        with suppress(BrokenPipeError, ConnectionResetError):
            for byte in content:
                self.wfile.write(bytes([byte]))
                time.sleep(self.state.pause)

    def log_message(self, *arguments):
        pass


class ServerState:
    """Files of the server, the failures it is to simulate, and the requests it received."""

    def __init__(self):
        self.files = {}
        self.failures = []
        self.requests = Counter()
        self.content_type = "text/plain"
        self.headers = {}
        self.pause = 0.0
        """Seconds after each byte."""
        self.url = ""


@pytest.fixture
def server(monkeypatch):
    monkeypatch.setenv("NO_PROXY", "127.0.0.1")
    state = ServerState()
    with ThreadingHTTPServer(("127.0.0.1", 0), partial(Tree, state)) as http:
        state.url = f"http://127.0.0.1:{http.server_port}/"
        thread = threading.Thread(target=http.serve_forever, args=(0.01,))
        thread.start()
        yield state
        http.shutdown()
        thread.join()
