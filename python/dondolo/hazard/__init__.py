"""Hazard curves and annual frequencies of collapse."""
