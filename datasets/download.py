"""Downloads that are retried, and checked before they are stored."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import requests
from requests.adapters import HTTPAdapter
from urllib3.util.retry import Retry

from mocapbench.basics.whole_files import stage_file
from mocapbench.datasets.errors import FetchError, ServerUnreachable

__all__ = ["Downloader"]

_TIMEOUT = 30.0
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
        self.base_url = base_url.rstrip("/") + "/"
        self.folder = folder
        self.retries = retries
        self.backoff = backoff

    def fetch(self, path: str, check: Callable[[bytes, str], None]) -> None:
        """Download one file; ``check`` gets its content and address before it is stored.

        Raises
        ------
        FetchError
            If the server has no such file, or does not deliver it.
        ServerUnreachable
            If the server does not answer.
        """
        url = self.base_url + path
        content = self._get(url)
        check(content, url)
        file = self.folder / path
        file.parent.mkdir(parents=True, exist_ok=True)
        with stage_file(file) as part:
            part.write_bytes(content)

    def _get(self, url: str) -> bytes:
        try:
            with self._session() as session:
                response = session.get(url, timeout=_TIMEOUT)
        except requests.RequestException as problem:
            raise ServerUnreachable(
                url,
                f"the server does not answer ({type(problem).__name__})",
                "check the network, or name a folder that holds the recordings with --data-dir",
            ) from problem
        if response.status_code == requests.codes.not_found:
            raise FetchError(
                url, "the server has no such file (404)", "check the number of the recording"
            )
        if not response.ok or "html" in response.headers.get("Content-Type", ""):
            raise FetchError(
                url,
                f"the server sent no recording (status {response.status_code}, "
                f"{response.headers.get('Content-Type', 'no content type')})",
                "try again later, or name a folder that holds the recordings with --data-dir",
            )
        return response.content

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
