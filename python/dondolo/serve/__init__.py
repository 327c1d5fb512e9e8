"""A page in the browser where a wall's fragility curve follows the sliders: ``dondolo serve``."""
