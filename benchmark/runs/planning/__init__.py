"""From what a user asks for to jobs: names, cases, entrants, parameters and keys."""
