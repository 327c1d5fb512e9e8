"""Analyses of many walls, block by block, and the curves of their population."""
