"""Analyses of one wall: a single motion, stripes, incremental, clouds, overturning spectra."""
