"""Calculation reports: what an office hands in, as Word, HTML or PDF, in Italian or English."""
