"""Of a list of values, by nearest rank."""
import math


def quantile(values, q):
    return sorted(values)[max(0, math.ceil(q * len(values)) - 1)] if values else math.nan
