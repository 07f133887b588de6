"""What ends a run on the workers of a scheduler whose client was killed."""

from __future__ import annotations

from distributed import Scheduler, SchedulerPlugin

__all__ = ["ClientWatch"]


class ClientWatch(SchedulerPlugin):
    """Ends what workers keep for a run when its client is gone, however that went.

    Parameters
    ----------
    client : str
        The client's id.
    run : str
        The name of the run's plug-in.
    """

    def __init__(self, client: str, run: str) -> None:
        self.name: str = f"{run}-watch"
        self._client = client
        self._run = run

    def remove_client(self, scheduler: Scheduler, client: str) -> None:
        """End the run if the client is its own."""
        if client == self._client:
            scheduler.plugins.pop(self.name, None)
            if self._run in scheduler.worker_plugins:  # else the client has ended the run itself
                scheduler.loop.add_callback(
                    scheduler.unregister_worker_plugin, comm=None, name=self._run
                )
