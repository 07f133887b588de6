"""One complete replicate in GPyTorch: its multitask kernel and likelihood."""

from __future__ import annotations

from collections.abc import Callable

import gpytorch
import numpy as np
import torch
from serve import serve

torch.set_default_dtype(torch.float64)
torch.set_num_threads(1)


class Multitask(gpytorch.models.ExactGP):
    """B ⊗ k, as in GPyTorch's own example of a multitask model."""

    def __init__(self, x, y, likelihood, rank: int) -> None:
        super().__init__(x, y, likelihood)
        n_tasks = y.shape[1]
        self.mean_module = gpytorch.means.MultitaskMean(gpytorch.means.ZeroMean(), n_tasks)
        self.covar_module = gpytorch.kernels.MultitaskKernel(
            gpytorch.kernels.MaternKernel(nu=1.5), num_tasks=n_tasks, rank=rank
        )

    def forward(self, x):
        return gpytorch.distributions.MultitaskMultivariateNormal(
            self.mean_module(x), self.covar_module(x)
        )


def pose(problem: np.lib.npyio.NpzFile) -> Callable[[], tuple[float, np.ndarray]]:
    """Return what evaluates the model at the problem's point."""
    y = torch.as_tensor(problem["data"][0].T.copy())
    likelihood = gpytorch.likelihoods.MultitaskGaussianLikelihood(
        y.shape[1], noise_constraint=gpytorch.constraints.Positive(), has_global_noise=False
    )
    model = Multitask(
        torch.as_tensor(problem["times"]), y, likelihood, problem["child weights"].shape[2]
    )
    _move(model, problem)
    mll = gpytorch.mlls.ExactMarginalLogLikelihood(likelihood, model)
    model.train()

    def evaluate() -> tuple[float, np.ndarray]:
        model.zero_grad()
        value = mll(model(*model.train_inputs), model.train_targets) * y.numel()
        value.backward()
        return value.item(), _gradient(model)

    return evaluate


def _move(model: Multitask, problem: np.lib.npyio.NpzFile) -> None:
    kernel = model.covar_module
    kernel.data_covar_module.lengthscale = float(problem["child lengthscales"][0])
    kernel.task_covar_module.covar_factor.data = torch.as_tensor(problem["child weights"][0])
    kernel.task_covar_module.var = torch.as_tensor(problem["child kappa"][0])
    model.likelihood.task_noises = torch.as_tensor(problem["noise"])


def _gradient(model: Multitask) -> np.ndarray:
    kernel = model.covar_module
    tasks = kernel.task_covar_module
    leaves = (
        (kernel.data_covar_module.raw_lengthscale, kernel.data_covar_module.lengthscale, 1.0),
        (tasks.raw_var, tasks.var, 0.5),
        (model.likelihood.raw_task_noises, model.likelihood.task_noises, 1.0),
    )
    # Every raw coordinate is the inverse softplus of x: dx / draw = 1 − e^(−x).
    scale, kappa, noise = (
        raw.grad * x.detach() ** power / -torch.expm1(-x.detach()) / power
        for raw, x, power in leaves
    )
    pieces = (scale, tasks.covar_factor.grad, kappa, noise)
    return np.concatenate([piece.numpy().ravel() for piece in pieces])


if __name__ == "__main__":
    serve(pose)
