"""How old each drive's report was in every tick, from the CAN logs alone; whether the core was told so."""
import collections

from liana.drive_names import drive_text

REPORT_BYTES = 8  # as TPDO 1 is mapped; others are not taken
OF_REPORTS = 0x180
UNHEARD = 1000000
MAX_AGE = 60000  # what the core counts up to
LATE = 2  # ticks that a report may take from the wire to the core


class Arrivals:
    """Slots in which each node's reports were on the wire, ascending."""

    def __init__(self, log_texts, line, period_s):
        self.reports = collections.defaultdict(list)
        for text in log_texts:
            for time, identifier, data in line.findall(text):
                found, node = divmod(int(identifier, 16), 0x80)
                slot = int(float(time) / period_s + 1e-6)
                if found * 0x80 == OF_REPORTS and len(data) == 2 * REPORT_BYTES:
                    self.reports[node].append(slot)


def ages(slots, first, count):
    """In each of `count` ticks from `first` on: ticks since the last of `slots` came, least and most. A tick mostly
    hears one tick later; what came in the tick itself it may have heard already, or not.
    """
    least, most, last, at = [], [], -UNHEARD, 0
    for tick in range(first, first + count):
        while at < len(slots) and slots[at] < tick:
            last, at = slots[at], at + 1
        most.append(tick - 1 - last)
        least.append(0 if at < len(slots) and slots[at] == tick else most[-1])
    return least, most


def wrong_ages(ticks, arrivals, left_out=()):
    """The core was told no report to be younger than the wire shows, and none to be lost that was there; `left_out`:
    drives in whose name somebody else spoke.
    """
    complaints = []
    for drive in range(len(ticks[0].age)):
        if drive in left_out:
            continue
        least, most = ages(arrivals.reports[drive + 1], ticks[0].tick, ticks[-1].tick - ticks[0].tick + 1)
        for now in ticks:
            youngest, oldest = (found[now.tick - ticks[0].tick] for found in (least, most))
            # What waited while the core stood still it takes for new when it goes on; 2001 is latched then.
            if not min(youngest - now.lost_ticks, MAX_AGE) <= now.age[drive] <= oldest + LATE:
                complaints.append(
                    f"tick {now.tick}: the core takes the report of {drive_text(drive)} to be {now.age[drive]} ticks old;"
                    f" the wire shows {youngest} to {oldest}"
                )
                break
    return complaints
