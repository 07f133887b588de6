"""Pictures of solved problems: one module per kind of picture.

A task's page declares which ones it shows, as functions of a solved problem: ``figures=
(draw_gap_error, partial(draw_latent_spaces, labels=...))``.
`illustrations` poses the problem of the case to show again, and lets each figure draw the stored
solutions.
"""
