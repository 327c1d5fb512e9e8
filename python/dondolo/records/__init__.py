"""Accelerograms: read, processed, made; and their intensity measures."""
