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
            result["executions"],
            f"{result['seconds']:.0f}",
            f"{result['executions'] / max(result['seconds'], 1e-3):.0f}",
            result["found"] or "none",
        ]
        for result in sorted(results, key=lambda result: result["name"])
    ]
    how = "AddressSanitizer and UndefinedBehaviorSanitizer, inputs of at most 1 KiB, from the corpus in tests/fuzz/corpus."
    return how + "\n\n" + table(["target", "executions", "s", "executions/s", "crashes"], rows)


def measure(_binaries):
    results = []
    for result in targets.run_all(targets.targets(), f"-runs={EXECUTIONS}", os.cpu_count()):
        print(targets.line(result), file=sys.stderr, flush=True)
        results.append(result)
    return {result["name"]: result for result in results}, text_of(results)
