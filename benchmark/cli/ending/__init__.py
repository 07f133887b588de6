"""How a command ends where a signal strikes or its output cannot be written: by which exit code."""
