"""Walls, populations of walls, and the distributions that they are drawn from."""
