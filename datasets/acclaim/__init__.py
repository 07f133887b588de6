"""The Acclaim format: strict readers and writers of skeletons (.asf) and motions (.amc)."""
