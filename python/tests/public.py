"""What the package offers its users."""

import dondolo as dd


def public_things():
    """Every public name with what it is: those at the top, types of results, distributions, and errors."""
    return {name: getattr(of, name) for of in (dd, dd.results, dd.distributions, dd.errors) for name in of.__all__}
