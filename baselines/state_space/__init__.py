"""Linear Gaussian state-space models: Kalman filter, smoother, and EM with weak priors.

The model of a recording y_1 … y_N in standardised units, with q states:

    x_1 = m + u,  x_{t+1} = A x_t + w_t,  y_t = C x_t + d + v_t,

with u ~ N(0, P), w_t ~ N(0, Q) and v_t ~ N(0, diag(r)). ``docs/mathematics/state-space.md`` has the
derivations and the choices. One idea a module:

* `linear_gaussian`: the parameters, their priors, and what they say about channels;
* `kalman`: the distribution of the states, by the Kalman filter and the smoother;
* `expectation_maximisation`: how parameters are learnt; `mixture`: of several models.
"""
