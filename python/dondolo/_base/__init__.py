"""Arguments, files and how objects show themselves: what every other room needs."""
