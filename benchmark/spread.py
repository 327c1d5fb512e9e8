"""Spread of a measurement that is repeated: median, quartiles, least and largest value."""

import statistics
from dataclasses import astuple, dataclass, fields


@dataclass(frozen=True)
class Spread:
    """Median, lower and upper quartile, least and largest of several values."""

    median: float
    lower: float
    upper: float
    least: float
    largest: float

    @classmethod
    def of(cls, values):
        """Spread of values, at least one."""
        values = sorted(values)
        quartiles = statistics.quantiles(values, method="inclusive") if len(values) > 1 else 3 * values
        lower, median, upper = quartiles
        return cls(median, lower, upper, values[0], values[-1])

    def times(self, factor):
        """The same of values multiplied by a positive factor."""
        return Spread(*(factor * value for value in astuple(self)))

    def stated(self, digits=3):
        """Median, quartiles and in brackets least and largest value: 7.5, 6.9 to 8.1 (5.9 to 8.9)."""
        median, lower, upper, least, largest = (rounded(value, digits) for value in astuple(self))
        if self.least == self.largest:
            return median
        return f"{median}, {lower} to {upper} ({least} to {largest})"


#: Names of the numbers of a spread
NAMES = tuple(field.name for field in fields(Spread))


def rounded(value, digits=2):
    """Format a number with so many significant digits and without an exponent."""
    return f"{float(f'{value:.{digits}g}'):.10g}"
