"""The boundary to Fortran."""
