"""What a killed process leaves beside its temporary files."""

from mocapbench.basics.system.base import LOCK


def leave_lock(path):
    """Leave the lock of a temporary file or folder, as the portable backend does."""
    path.parent.mkdir(parents=True, exist_ok=True)
    path.with_name(f"{path.name}{LOCK}").touch()
