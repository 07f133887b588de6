"""The hierarchical model of cyclic motion: styles, cycles and alignment by variational EM.

The model is that of W. Pan and L. Torresani (2009), *Unsupervised Hierarchical Modeling of
Locomotion Styles*, ICML, cited as HLM. ``docs/mathematics/alignment.md`` has the
mathematics. One idea a module:

* `ring`: Gaussians on a cycle; `chain`: the hidden Markov chain; `priors`: the prior of a cycle;
* `cycle_model`: the variables, expectations and the bound; `updates`: variational EM;
* `cycle_start`: where EM starts; `restarts`: EM from random starts; `profile`: the continuous
  profile model;
* `inference`: new sequences and hidden entries; `new_motion`: new cycles and sequences;
* `aligner`: what all estimators share.
"""
