"""The exact Gaussian-process core.

Data pass through its folders and modules in this order:

* `prior`: kernels, coregionalisation matrices and the parameters of both;
* `reduction`: recordings become a few small Gaussian problems of one form, exactly;
* `solvers`: interchangeable exact methods evaluate, differentiate and condition such a problem
  (`solvers.dense`, `solvers.kronecker`, `solvers.latent_split`, `solvers.state_space`), and
  `planner` chooses the one with the least work; `threads` share it;
* `training`: the parameters of largest likelihood are searched for;
* `posterior`: predictions, joint covariances and draws with these parameters;
* `estimator`: the base class of the models, on `covariances` (what is learnt), `imputation` (what
  is predicted) and `synthesis` (what is drawn). `trended` adds a trend to it; `channelwise` and
  `channel_posteriors` make one model for each channel. `registration` moves recordings in time
  before; `conditioned` is what is known after.

``docs/mathematics/inference.md`` has the mathematics in the names used here.
"""
