"""How the report presents our tasks, one page a module; no page changes a result."""
