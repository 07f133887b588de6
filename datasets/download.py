"""Downloads that are retried, and checked before they are stored."""

from __future__ import annotations

from collections.abc import Callable
from concurrent.futures import Future
from functools import partial
from pathlib import Path
from threading import Thread

import requests
from requests.adapters import HTTPAdapter
from urllib3.util.retry import Retry

from mocapbench.basics.whole_files import stage_file
from mocapbench.datasets.errors import FetchError, ServerUnreachable

__all__ = ["Downloader"]

_TIMEOUT = 30.0
_MOST_SECONDS = 600.0
_MOST_BYTES = 2**28  # unpacked: as many as are read of a motion
_CHUNK = 2**14  # in bytes, packed: what they unpack to is held before it is counted
_ELSEWHERE = "try again later, or name a folder that holds the recordings with --data-dir"
_OVERLOADED = (500, 502, 503, 504)


class Downloader:
    """Gets files from below one address into one folder, under the same relative paths.

    Parameters
    ----------
    base_url : str
        Address of the tree.
    folder : Path
        Where to put files; a file gets its final name only after it was checked.
    retries : int
        How often to try again after a lost connection or a status of 500, 502, 503 or 504.
    backoff : float
        Seconds to wait before the second retry, doubled for each further one.
    """

    def __init__(self, base_url: str, folder: Path, *, retries: int, backoff: float) -> None:
        self.base_url: str = base_url.rstrip("/") + "/"
        self.folder = folder
        self.retries = retries
        self.backoff = backoff

    def fetch(self, path: str, check: Callable[[bytes, str], object]) -> None:
        """Download one file; ``check`` gets its content and address before it is stored.

        Raises
        ------
        FetchError
            If the server has no such file, or does not deliver it: it takes more than ten minutes,
            or has more than 256 MiB.
        ServerUnreachable
            If the server does not answer.
        """
        url = self.base_url + path
        content = self._get_in_time(url)
        check(content, url)
        file = self.folder / path
        file.parent.mkdir(parents=True, exist_ok=True)
        with stage_file(file) as part:
            part.write_bytes(content)

    def _get_in_time(self, url: str) -> bytes:
        # A server that sends a byte now and then never meets the limit of a single read.
        content: Future[bytes] = Future()
        Thread(target=lambda: _settle(content, partial(self._get, url)), daemon=True).start()
        try:
            return content.result(_MOST_SECONDS)
        except TimeoutError as problem:
            raise ServerUnreachable(
                url, f"the server takes more than {_MOST_SECONDS:.0f} s", _ELSEWHERE
            ) from problem

    def _get(self, url: str) -> bytes:
        try:
            with (
                self._session() as session,
                session.get(url, timeout=_TIMEOUT, stream=True) as answer,
            ):
                _check_answer(url, answer)
                return _read_content(url, answer)
        except requests.RequestException as problem:
            raise ServerUnreachable(
                url,
                f"the server does not answer ({type(problem).__name__})",
                "check the network, or name a folder that holds the recordings with --data-dir",
            ) from problem

    def _session(self) -> requests.Session:
        session = requests.Session()
        retry = Retry(
            total=self.retries,
            backoff_factor=self.backoff,
            status_forcelist=_OVERLOADED,
            raise_on_status=False,
            # A server may set a delay of hours.
            respect_retry_after_header=False,
        )
        for scheme in ("http://", "https://"):
            session.mount(scheme, HTTPAdapter(max_retries=retry))
        return session


def _check_answer(url: str, answer: requests.Response) -> None:
    if answer.status_code == requests.codes.not_found:
        raise FetchError(
            url, "the server has no such file (404)", "check the number of the recording"
        )
    content_type = answer.headers.get("Content-Type", "no content type")
    if not answer.ok or "html" in content_type:
        raise FetchError(
            url,
            f"the server sent no recording (status {answer.status_code}, {content_type})",
            _ELSEWHERE,
        )


def _read_content(url: str, answer: requests.Response) -> bytes:
    """Return what the server sends, unpacked, but not without end."""
    content = bytearray()
    for chunk in answer.iter_content(_CHUNK):
        content += chunk
        if len(content) > _MOST_BYTES:
            raise FetchError(url, f"it has more than {_MOST_BYTES >> 20} MiB", _ELSEWHERE)
    return bytes(content)


def _settle(future: Future[bytes], work: Callable[[], bytes]) -> None:
    """Give a future what some work returns or raises."""
    try:
        future.set_result(work())
    except Exception as problem:  # whoever waits for it raises it
        future.set_exception(problem)
