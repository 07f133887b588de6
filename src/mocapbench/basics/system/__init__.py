"""What depends on the operating system: once by what Linux has, once by what every system has."""
