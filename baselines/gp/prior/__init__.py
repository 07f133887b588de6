"""The prior: kernels, layers with their parameters and draws, kernels as Markov processes."""
