"""How the time of an analysis grows: a few constants fitted to the measured times, with what they leave unexplained."""

import numpy as np
from scipy.optimize import nnls


def of_call(rows):
    """Seconds of a call of multiple_stripe: a + b records + c histories, by least squares of the relative errors.

    Returns a, b and c, none of them negative, and the largest relative error of a measurement that was fitted.
    """
    own = [row for row in rows if row["kind"] in ("records", "levels")]
    # Of records the size is their number; levels ran with all records.
    largest = max(row["size"] for row in own if row["kind"] == "records")
    records = np.array([row["size"] if row["kind"] == "records" else largest for row in own])
    histories = np.array([row["histories"] for row in own])
    seconds = np.array([row["value"] for row in own])
    terms = np.column_stack([np.ones(len(own)), records, histories]) / seconds[:, None]
    constants, _ = nnls(terms, np.ones(len(own)))
    return constants, float(np.abs(terms @ constants - 1.0).max())


def growth(rows, kind):
    """Exponent of the growth of the time with a size: the slope of the logarithms, by least squares."""
    own = [row for row in rows if row["kind"] == kind]
    size, seconds = (np.log([row[what] for row in own]) for what in ("size", "value"))
    return float(np.polyfit(size, seconds, 1)[0])


def serial_share(rows):
    """Share of the work that threads do not divide, by Amdahl's law and least squares; None: there is one thread."""
    own = [row for row in rows if row["kind"] == "strong efficiency"]
    threads, efficiency = (np.array([row[what] for row in own]) for what in ("size", "value"))
    if len(own) < 2:
        return None
    # t(n)/t(1) = 1/(n efficiency) = s + (1 - s)/n
    drop = 1.0 - 1.0 / threads
    return max(0.0, float(drop @ (1.0 / (threads * efficiency) - 1.0 / threads) / (drop @ drop)))
