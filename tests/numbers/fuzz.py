"""Every fuzz target, ten million executions in one run each, as many targets at a time as there are cores."""
import os
import sys

import folders  # makes what is in tests/fuzz importable
import targets
from page import table

EXECUTIONS = 10_000_000


def text_of(results):
    rows = [
        [
            result["name"],
            result["bytes"],
            result["executions"],
            f"{result['seconds']:.0f}",
            f"{result['executions'] / max(result['seconds'], 1e-3):.0f}",
            result.get("again", "-"),
            result["found"] or "none",
        ]
        for result in sorted(results, key=lambda result: result["name"])
    ]
    how = (
        "The build is hardened as what is installed, with the standard library's assertions; every input that reached"
        " something new then ran again with AddressSanitizer and UndefinedBehaviorSanitizer. Inputs have at most so many"
        " bytes as the table says, from the corpus in tests/fuzz/corpus, of which none is cut."
    )
    return (
        how + "\n\n" + table(["target", "bytes at most", "executions", "s", "executions/s", "again", "crashes"], rows)
    )


def measure(_binaries):
    results = []
    for result in targets.run_all(targets.targets(), os.cpu_count(), lambda name: targets.run_many(name, EXECUTIONS)):
        print(targets.line(result), file=sys.stderr, flush=True)
        results.append(result)
    return {result["name"]: result for result in results}, text_of(results)
