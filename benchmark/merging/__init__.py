"""Merging: several run directories become one, as if one run had computed them."""
