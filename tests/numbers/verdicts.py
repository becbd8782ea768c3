"""Commands with known verdicts (tests/host/control/verification/corpus.hpp), drawn anew from so many seeds that no test has.

Alone: verdicts.py [--bin DIR] [--count SEEDS] [--json].
"""

import json
import subprocess

from page import table

HEAD = ["class", "commands", "wrong accepts", "wrong refusals", "refused for another reason"]
FIELDS = ("class", "commands", "wrong_accepts", "wrong_refusals", "other_code")


def measure(binaries, count=100):
    call = [str(binaries / "verdicts"), "--count", str(count), "--json"]
    done = subprocess.run(call, capture_output=True, text=True, check=False)
    classes = json.loads(done.stdout)
    wrong = "".join(f"\n- {line}" for line in done.stderr.splitlines())
    return classes, table(HEAD, [[each[field] for field in FIELDS] for each in classes]) + "\n" + wrong


if __name__ == "__main__":
    import alone

    alone.run(measure, __doc__)
