"""The prior: kernels, the parameters of layers, kernels as Markov processes, and draws."""
