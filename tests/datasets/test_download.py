"""Downloads from a real server on the loopback interface."""

import gzip
import pickle
import socket
import subprocess
import sys
from pathlib import Path

import pytest

from mocapbench.datasets import FetchError, ServerUnreachable, download
from mocapbench.datasets.download import Downloader

PATH = "subjects/01/01.asf"


@pytest.fixture
def downloader(server, tmp_path):
    server.files[PATH] = b"content\n"
    return Downloader(server.url, tmp_path, retries=2, backoff=0.0)


def accept(content, url):
    assert content
    assert url.endswith(PATH)


def test_a_file_arrives_under_its_path(downloader, tmp_path):
    downloader.fetch(PATH, accept)
    assert (tmp_path / PATH).read_bytes() == b"content\n"


@pytest.mark.parametrize("status", [500, 502, 503, 504])
def test_a_request_to_an_overloaded_server_is_repeated(downloader, server, tmp_path, status):
    server.failures = [status, status]
    downloader.fetch(PATH, accept)
    assert (tmp_path / PATH).read_bytes() == b"content\n"
    assert server.requests[PATH] == 3


def test_the_number_of_retries_is_limited(downloader, server):
    server.failures = [503] * 3
    with pytest.raises(FetchError, match="status 503") as caught:
        downloader.fetch(PATH, accept)
    assert "try again later" in caught.value.remedy
    assert server.requests[PATH] == 3


def test_a_request_for_a_file_that_does_not_exist_is_not_repeated(downloader, server, tmp_path):
    with pytest.raises(FetchError, match="404") as caught:
        downloader.fetch("subjects/01/01_99.amc", accept)
    assert caught.value.what == server.url + "subjects/01/01_99.amc"
    assert server.requests["subjects/01/01_99.amc"] == 1
    assert not list(tmp_path.rglob("*.amc"))


def test_a_web_page_is_no_recording(downloader, server):
    server.content_type = "text/html; charset=utf-8"
    with pytest.raises(FetchError, match="text/html"):
        downloader.fetch(PATH, accept)


def test_a_file_that_unpacks_to_more_than_the_limit_is_not_kept(
    downloader, server, tmp_path, monkeypatch
):
    monkeypatch.setattr(download, "_MOST_BYTES", 2**20)
    server.files[PATH] = gzip.compress(bytes(2**22))
    server.headers["Content-Encoding"] = "gzip"
    with pytest.raises(FetchError, match="more than 1 MiB"):
        downloader.fetch(PATH, accept)
    assert not list(tmp_path.rglob("*.asf"))


def test_a_server_that_sends_a_byte_now_and_then_is_left(downloader, server, tmp_path, monkeypatch):
    monkeypatch.setattr(download, "_MOST_SECONDS", 0.3)
    server.files[PATH] = bytes(100)
    server.pause = 0.05
    with pytest.raises(ServerUnreachable, match="takes more than"):
        downloader.fetch(PATH, accept)
    assert not list(tmp_path.rglob("*.asf"))


def test_what_the_check_refuses_is_not_kept(downloader, tmp_path):
    def refuse(content, url):
        raise ValueError("wrong")

    with pytest.raises(ValueError, match="wrong"):
        downloader.fetch(PATH, refuse)
    assert not [path for path in tmp_path.rglob("*") if path.is_file()]


def test_a_write_that_fails_leaves_nothing(downloader, tmp_path, monkeypatch):
    def fail(file, target):
        assert file.read_bytes() == b"content\n"
        raise OSError("no space left")

    monkeypatch.setattr(Path, "replace", fail)
    with pytest.raises(OSError, match="no space left"):
        downloader.fetch(PATH, accept)
    assert not [path for path in tmp_path.rglob("*") if path.is_file()]


def test_without_a_network_the_error_names_it(tmp_path, monkeypatch):
    monkeypatch.setenv("NO_PROXY", "127.0.0.1")
    with socket.socket() as closed:
        closed.bind(("127.0.0.1", 0))  # bound and not listening: connections are refused
        url = f"http://127.0.0.1:{closed.getsockname()[1]}/"
        with pytest.raises(ServerUnreachable, match="check the network") as caught:
            Downloader(url, tmp_path, retries=1, backoff=0.0).fetch(PATH, accept)
    assert isinstance(caught.value, FetchError)


def test_its_errors_can_be_pickled():
    error = pickle.loads(pickle.dumps(ServerUnreachable("what", "why", "remedy")))
    assert str(error) == "what: why; remedy"


def test_who_downloads_nothing_loads_no_library_for_it():
    code = (
        "import sys\n"
        "from mocapbench.datasets import open_archive\n"
        "open_archive().recording('gait:01_01')\n"
        "assert not {'requests', 'urllib3'} & set(sys.modules)\n"
    )
    subprocess.run([sys.executable, "-c", code], check=True, timeout=120)
