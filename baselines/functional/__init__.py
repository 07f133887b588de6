"""Cyclic motion as smooth periodic functions, after Ormoneit, Black, Hastie and Kjellström 2005.

``docs/mathematics/functional.md`` has the mathematics, and what differs from the paper. One idea a
module:

* `basis`: Fourier series; `statistics`: sums over visible entries;
* `period`: the length of a cycle; `shifts`: recordings shifted to a common curve;
* `cycles`: recordings cut into cycles; `components`: the model of cycles, its posterior and its
  update; `fitting`: the rounds;
* `placement`: new recordings on the cycle; `prediction`: entries that the model predicts;
* `validation`: checks of the estimators' parameters.
"""
