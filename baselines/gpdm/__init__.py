"""Gaussian process dynamical models: latent trajectories, poses, and the ways to learn them.

One idea a module: `kernels` with their reverse derivatives, the Gaussian `process` that both
mappings are, the `dynamics`, the joint `posterior`, `learning` and `two_stage` learning with `hmc`,
the `conditional` model of a further sequence and the `starts` of its trajectory, `rollout` of new
ones, and the `estimator` that puts them together for a `model`.
"""
