"""A day of archive in accelerated time: its size, how soon any minute is read; and its writer, killed 100 times.

Alone: archive.py [--bin DIR] [--count SECONDS] [--json].
"""

from asking import counted
from page import table

KILLS = 100


def measure(binaries, count=86400):
    day = counted(binaries / "archive_day", count)
    kills = counted(binaries / "archive_kills", KILLS)
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
    ]
    return {"day": day, "kills": kills}, table(["what", "measured"], rows)


if __name__ == "__main__":
    import alone

    alone.run(measure, __doc__)
