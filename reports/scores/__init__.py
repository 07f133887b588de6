"""The tables of scores: a row a model, a column a case."""
