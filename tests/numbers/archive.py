"""A day of archive and of its control-rate ring in accelerated time: size, how soon any minute is read; and the
archive's writer, killed 100 times. The ring's ticks are those of a recorded run, again and again.

Alone: archive.py [--bin DIR] [--count SECONDS] [--json].
"""

import json
import subprocess
import tempfile

from asking import counted
from page import table

KILLS = 100


def ring_of(binaries, count):
    """What archive_ring measures; CalledProcessError when a run or the ring fails."""
    with tempfile.TemporaryDirectory(prefix="liana-numbers-") as folder:
        run = [binaries / "liana", "run", "slit_crossing", "--seed", "1", "--record", folder]
        subprocess.run(run, capture_output=True, check=True)
        ring = [binaries / "archive_ring", "--recording", folder, "--count", str(count), "--json"]
        return json.loads(subprocess.run(ring, capture_output=True, text=True, check=True).stdout)


def measure(binaries, count=86400):
    day = counted(binaries / "archive_day", count)
    kills = counted(binaries / "archive_kills", KILLS)
    ring = ring_of(binaries, count)
    rows = [
        ["arm time", f"{day['seconds'] / 3600:.2f} h, 120 numbers at 50 Hz, always moving"],
        ["records, commands", f"{day['records']}, {day['commands']}"],
        ["whole, gaps", f"{'yes' if day['whole'] else 'NO'}, {day['gaps']}"],
        ["telemetry", f"{day['telemetry_bytes_a_day'] / 1e9:.2f} GB a day"],
        ["all files", f"{day['all_bytes_a_day'] / 1e9:.2f} GB a day"],
        ["written in", f"{day['written_in_s']:.0f} s"],
        ["any minute of it", f"median {day['minute_median_ms']:.1f} ms, worst {day['minute_worst_ms']:.1f} ms"],
        ["writer killed", f"{kills['kills']} times"],
        ["acknowledged rows, of them missing", f"{kills['acknowledged']}, {kills['missing']}"],
        ["files not whole", len(kills["problems"])],
        ["ring: arm time", f"{ring['seconds'] / 3600:.2f} h of a recorded run at 250 Hz, a fault every hour"],
        ["ring: ticks, gaps, whole", f"{ring['ticks']}, {ring['gaps']}, {'yes' if ring['whole'] else 'NO'}"],
        ["ring: Inputs and checksum", f"{ring['inputs_bytes_a_tick']:.1f} B a tick"],
        ["ring: Outputs", f"{ring['outputs_bytes_a_tick']:.1f} B a tick"],
        ["ring: most at any time", f"{ring['most_bytes'] / 1e9:.2f} GB (allowed 1.5 GB in 24 h)"],
        ["ring: any minute of it", f"median {ring['minute_median_ms']:.0f} ms, worst {ring['minute_worst_ms']:.0f} ms"],
        ["ring: written in", f"{ring['written_in_s']:.0f} s, {ring['us_a_tick']:.1f} us a tick"],
        ["ring: verified in", f"{ring['checked_in_s']:.0f} s"],
    ]
    return {"day": day, "kills": kills, "ring": ring}, table(["what", "measured"], rows)


if __name__ == "__main__":
    import alone

    alone.run(measure, __doc__)
