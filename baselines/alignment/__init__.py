"""The hierarchical model of cyclic motion after HLM: styles, cycles and alignment by EM.

One idea a module: padded `sequences`, Gaussians on a `ring`, the Markov `chain`, the `priors` of a
cycle, the `model`'s variables, their `expectations`, `updates` and `bound`, the `start` and the
`em` algorithm that runs them. ``docs/alignment.md`` has the mathematics.
"""
