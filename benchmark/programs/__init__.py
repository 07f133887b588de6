"""Models that are programs of their own, in any language: a TOML file names the command."""
