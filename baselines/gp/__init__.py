"""The exact Gaussian-process core.

Data pass through its folders and modules in this order:

* `prior`: kernels, coregionalisation matrices and the parameters of both;
* `reduction`: recordings become a few small Gaussian problems of one form, exactly;
* `solvers`: interchangeable exact methods evaluate, differentiate and condition such a problem
  (`solvers.dense`, `solvers.kronecker`, `solvers.latent_split`, `solvers.state_space`),
  `solvers.planner` chooses the one with the least work, and `solvers.threads` share it;
* `training`: the parameters of largest likelihood are searched for;
* `process`: a fitted process as a value, with means, variances, covariances and draws of curves;
  `leave_one_out`: its predictions of visible entries that are left out one by one;
* `estimator`: the one estimator, which learns a process and predicts by it. `channelwise` makes
  one for each channel. `registration` moves recordings in time before; `parameter_docs` has the
  models' docstrings say what they share.

``docs/mathematics/inference.md`` has the mathematics in the names used here.
"""
