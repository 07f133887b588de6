"""Pictures of solved problems: one module per kind of picture.

A task's page declares which ones it shows, as values: ``figures=(GapError(), LatentSpaces(...))``.
`illustrations` poses the problem of the case to show again, and lets each figure draw the stored
answers.
"""
