"""Files of others and of the executable: cases, results, OpenQuake's NRML."""
