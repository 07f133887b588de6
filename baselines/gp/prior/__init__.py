"""The prior: kernels, coregionalisation, the parameters of both, and draws (`sampling`)."""
