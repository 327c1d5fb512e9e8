"""What the package offers its users."""

import dondolo as dd


def public_things():
    """Every public name with what it is: those at the top, types of results, and distributions."""
    return {name: getattr(of, name) for of in (dd, dd.results, dd.distributions) for name in of.__all__}
