"""The hierarchical model of cyclic motion: styles, cycles and alignment by variational EM.

The model is that of W. Pan and L. Torresani (2009), *Unsupervised Hierarchical Modeling of
Locomotion Styles*, ICML, cited as HLM. ``docs/mathematics/alignment.md`` has the
mathematics. One idea a module:

* `sequences`: padded arrays; `ring`: Gaussians on a cycle; `chain`: the hidden Markov chain;
* `priors`: the prior of a cycle; `model`: the variables; `expectations`, `updates`, `bound`: the
  quantities of variational EM;
* `period`: the length of a cycle; `start`: initial states and styles; `em`: the algorithm;
  `fitting`: EM with restarts; `inference`: new sequences and hidden entries; `synthesis`: new
  motion;
* `profile`: the continuous profile model; `estimator`: what all estimators share; `validation`:
  checks of their parameters.
"""
