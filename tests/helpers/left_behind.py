"""What a killed process leaves beside its temporary files."""

from mocapbench.basics.system.base import LOCK
from mocapbench.basics.system.choice import find_system
from mocapbench.basics.system.portable import Portable


def leave_lock(path):
    """Leave the lock of a temporary file or folder where the backend is the portable one."""
    path.parent.mkdir(parents=True, exist_ok=True)
    if isinstance(find_system(), Portable):
        path.with_name(f"{path.name}{LOCK}").touch()
