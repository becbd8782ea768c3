"""Asking the built programs, and the words and poses that go with it."""
import json
import math
import subprocess


def ask(program, *words, text=None):
    """What a program prints as JSON, whatever its exit code; RuntimeError with what it said when it printed nothing."""
    done = subprocess.run([str(program), *map(str, words)], input=text, capture_output=True, text=True, check=False)
    if not done.stdout:
        raise RuntimeError(done.stderr)
    return json.loads(done.stdout)


def counted(program, count):
    """What a measuring program (--count, --json) prints; CalledProcessError when it fails."""
    call = [str(program), "--count", str(count), "--json"]
    return json.loads(subprocess.run(call, capture_output=True, text=True, check=True).stdout)


def joined(numbers):
    """Numbers as an option takes them."""
    return ",".join(map(repr, numbers))


def quaternion_of(r):
    """Quaternion [w, x, y, z] of a rotation matrix by its most stable form."""
    q = [
        math.sqrt(max(0.0, 1 + s[0] * r[0][0] + s[1] * r[1][1] + s[2] * r[2][2])) / 2
        for s in ((1, 1, 1), (1, -1, -1), (-1, 1, -1), (-1, -1, 1))
    ]
    k = max(range(4), key=q.__getitem__)
    v = [r[2][1] - r[1][2], r[0][2] - r[2][0], r[1][0] - r[0][1]]
    if k == 0:
        return [q[0]] + [x / (4 * q[0]) for x in v]
    i = k - 1
    out = [v[i] / (4 * q[k]), 0.0, 0.0, 0.0]
    for j in range(3):
        out[j + 1] = q[k] if j == i else (r[i][j] + r[j][i]) / (4 * q[k])
    return out
