"""Where and how jobs run: each in a process of its own, on this machine or on a cluster."""
