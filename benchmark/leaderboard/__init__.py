"""A leaderboard: runs of several laboratories, each sent as one small archive, on one site."""
