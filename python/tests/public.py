"""What the package offers its users."""

import dondolo as dd


def public_things():
    """Every public name with what it stands for: those at the top, and the types of results."""
    top = {name: getattr(dd, name) for name in dd.__all__}
    return top | {name: getattr(dd.results, name) for name in dd.results.__all__}
