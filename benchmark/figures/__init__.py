"""Pictures of solutions: one module per kind of picture, each a value that a task declares."""
