"""Cyclic motion as smooth periodic functions, after Ormoneit, Black, Hastie and Kjellström 2005.

``docs/mathematics/functional.md`` has the mathematics, and what differs from the paper. One idea a
module:

* `fourier_series`: periodic functions, and sums over the visible entries of curves;
* `cycle_period`: the length of a cycle; `phases`: recordings on it, and cut into cycles;
* `components`: the model of cycles, how it is fitted, and the entries that it predicts.
"""
