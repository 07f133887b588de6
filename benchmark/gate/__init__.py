"""The regression gate: whether a run is as good as its reference values, or as a control.

`reference` reads and writes the values, `rule` decides one metric, `check` all of them by the
`tolerances`, and `output` says it to people and machines; `negative_control` holds samples
against those of an unrelated process.
"""
