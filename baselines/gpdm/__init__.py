"""Gaussian process dynamical models: latent trajectories, poses and learning algorithms.

The models are those of J. M. Wang, D. J. Fleet and A. Hertzmann (2008), *Gaussian Process
Dynamical Models for Human Motion*, IEEE TPAMI 30(2), cited as GPDM. One idea a module:

* `kernels`: covariance functions with their reverse-mode derivatives;
* `regression`: the Gaussian process behind both mappings, to poses and to the next position;
* `dynamics`: priors of latent trajectories;
* `posterior`: the joint posterior density of latent positions and parameters;
* `learning` and `two_stage`: the learning algorithms; `descent` and `hmc`: the optimiser and the
  sampler that they use;
* `conditional`: the density of a further sequence; `starts`: where its optimisation starts;
* `rollout`: new trajectories; `synthesis`: new recordings from them;
* `sequences`: training recordings as the models take them;
* `latent_variable_model`: the common estimator; `model`: the GPDM itself.
"""
