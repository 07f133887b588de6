"""The Acclaim format: skeletons (.asf) and motions (.amc), read strictly and written."""
