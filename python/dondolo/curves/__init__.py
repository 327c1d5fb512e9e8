"""Fragility curves, their uncertainty, and regressions."""
