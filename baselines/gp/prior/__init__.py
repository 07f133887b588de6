"""The prior: kernels, coregionalisation, and the parameters of both."""
