"""How a command ends: what it says of an error, where a signal strikes, and by which exit code."""
