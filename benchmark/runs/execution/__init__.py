"""Where and how jobs run: each model in a process of its own, on this machine or a cluster."""
