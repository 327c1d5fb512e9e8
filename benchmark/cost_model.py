"""Growth of the time of an analysis: a few constants fitted to the measured times, with what they leave unexplained."""

import numpy as np
from scipy.optimize import nnls


def of_call(rows):
    """Seconds of a call of multiple_stripe: a + b records + c histories, by least squares of the relative errors.

    Returns a, b and c, none of them negative, and the largest relative error of a measurement that was fitted.
    """
    own = [row for row in rows if row["kind"] in ("records", "levels")]
    # Of records the size is their number; levels ran with all records.
    largest = most_records(rows)
    records = np.array([row["size"] if row["kind"] == "records" else largest for row in own])
    histories = np.array([row["histories"] for row in own])
    seconds = np.array([row["median"] for row in own])
    terms = np.column_stack([np.ones(len(own)), records, histories]) / seconds[:, None]
    constants, _ = nnls(terms, np.ones(len(own)))
    return constants, float(np.abs(terms @ constants - 1.0).max())


def most_records(rows):
    """Largest number of records, with which the levels ran."""
    return max(row["size"] for row in rows if row["kind"] == "records")


def growth(rows, kind):
    """Factor and exponent of the growth of the time with a size: seconds = factor size^exponent.

    Least squares of the logarithms.
    """
    own = [row for row in rows if row["kind"] == kind]
    size, seconds = (np.log([row[what] for row in own]) for what in ("size", "median"))
    exponent, factor = np.polyfit(size, seconds, 1)
    return float(np.exp(factor)), float(exponent)


def modelled(rows, kind, sizes):
    """Seconds that the fitted model gives for sizes of a kind."""
    if kind not in ("records", "levels"):
        factor, exponent = growth(rows, kind)
        return factor * sizes**exponent
    (call, record, history), _ = of_call(rows)
    records = sizes if kind == "records" else most_records(rows)
    one = next(row for row in rows if row["kind"] == kind)
    return call + record * records + history * sizes * (one["histories"] / one["size"])


def serial_share(rows):
    """Share of the work that threads do not divide, by Amdahl's law and least squares; None if there is one thread."""
    own = [row for row in rows if row["kind"] == "strong efficiency"]
    threads, efficiency = (np.array([row[what] for row in own]) for what in ("size", "median"))
    if len(own) < 2:
        return None
    # t(n)/t(1) = 1/(n efficiency) = s + (1 - s)/n
    drop = 1.0 - 1.0 / threads
    return max(0.0, float(drop @ (1.0 / (threads * efficiency) - 1.0 / threads) / (drop @ drop)))


def speed_up(share, threads):
    """Speed-up by Amdahl's law, with a share of the work that threads do not divide."""
    return 1.0 / (share + (1.0 - share) / threads)
