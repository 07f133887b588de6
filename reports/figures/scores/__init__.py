"""Figures of scores: along a column, by case, by frame, by joint, against cost and the papers."""
