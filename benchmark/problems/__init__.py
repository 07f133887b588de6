"""Problems: what a model may see, what it may not, and how its solution meets the truth.

One module per kind of problem (`impute`, `synthesise`, `cluster`, `recover`) on the contract of
`base`; `masks` hides entries, and `internals` keeps what a fitted model shows besides its solution.
"""
