"""Cases that are each drawn from a seed, several at once."""
import concurrent.futures
import functools
import os
import sys

import folders  # makes what follows importable
from liana.client import LianaError


def named(one, what, seed):
    """What a client raises does not pass from one process to another, and does not say whose it was."""
    try:
        return one(seed)
    except LianaError as error:
        raise RuntimeError(f"{what} {seed}: {error}") from None


def found(one, what, binaries, seeds, told, jobs=None):
    """The figures of each case `one(seed)`; `told(figures)` is said of it as soon as it is there."""
    os.environ["LIANA_BIN"] = str(binaries.resolve())
    figures = []
    with concurrent.futures.ProcessPoolExecutor(jobs or os.cpu_count()) as pool:
        for each in pool.map(functools.partial(named, one, what), seeds):
            figures.append(each)
            print(f"   {each['seed']} {told(each)}", file=sys.stderr, flush=True)
    return figures
