"""Benchmarks of users' own recordings: task files in TOML, and the recordings that they name.

`document` reads the TOML and knows on which line a key stands, `settings` says which keys there are
and what they mean, `finding` looks for the recordings, `checking` tries the whole on them, and
`building` makes a task of it. `selection`, `hiding` and `problem` are the protocol, which keys of
results cover; `library` has the recordings. `template` writes the first task file, of the
recordings that `grouping` finds.
"""
