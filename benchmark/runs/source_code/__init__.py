"""Source code of modules: what a module builds on, and whose it is."""
