"""Settings of all tests."""

from hypothesis import settings

# A deadline would assert a wall-clock time.
settings.register_profile("no-clock", deadline=None)
settings.load_profile("no-clock")
