"""Checks of walls by building codes."""
