"""Exact inference in one block, by interchangeable methods with one interface (`solver`).

`planner` chooses among them; `threads` share their work.
"""
