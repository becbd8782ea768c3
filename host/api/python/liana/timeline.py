"""A run's report beside an expected timeline: `python3 -m liana.timeline report.json timeline.json`.

An expected timeline (lua/missions/payload_timeline.json) has events, each the begin or end of a step of the mission, with
the time at which the source's flight had it and, where that is to be judged, the shortest and longest time after another
event. Waits for people are not judged: they last as long as people take.
"""
from __future__ import annotations

import dataclasses
import json
import pathlib
import sys
from typing import Any, Optional

Json = dict[str, Any]


@dataclasses.dataclass
class Row:
    """One event: the flight's time and ours since the first event [s]; `fault` is empty where it is as expected."""

    event: str
    flight_s: Optional[float]
    ours_s: Optional[float]
    after: str = ""
    took_s: Optional[float] = None
    fault: str = ""


def step_times(report: Json) -> dict[str, tuple[float, float]]:
    """Begin and end [s since the mission's first step] of every step that succeeded, of the last time that it did."""
    times, now_s = {}, 0.0
    for step in report["steps"]:
        begun_s, now_s = now_s, now_s + step["duration_s"]
        if step["outcome"] == "success":
            times[step["name"]] = (begun_s, now_s)
    return times


def compare(report: Json, timeline: Json) -> list[Row]:
    """A row for every event of the timeline, in its order."""
    times = step_times(report)
    at: dict[str, float] = {}
    rows = []
    for event in timeline["events"]:
        row = Row(event["event"], event.get("flight_s"), None, event.get("after", ""))
        if event["step"] in times:
            at[row.event] = times[event["step"]][event["edge"] == "end"]
            row.ours_s = at[row.event] - at.get(timeline["zero"], 0.0)
        judge(row, event, at)
        rows.append(row)
    for before, row in zip(rows, rows[1:]):
        if before.ours_s is not None and row.ours_s is not None and row.ours_s < before.ours_s - 1e-6:
            row.fault = row.fault or f"before {before.event}"
    return rows


def judge(row: Row, event: Json, at: dict[str, float]) -> None:
    """Sets `took_s` and `fault` of an event from where it and the event before are."""
    if row.event not in at:
        row.fault = f"step \"{event['step']}\" did not succeed"
        return
    if not row.after or row.after not in at:
        row.fault = f"no {row.after}" if row.after else ""
        return
    row.took_s = at[row.event] - at[row.after]
    least_s, most_s = event["within_s"]
    if not least_s <= row.took_s <= most_s:
        row.fault = f"{row.took_s:.1f} s after {row.after}, expected {least_s:g} to {most_s:g}"


def text(rows: list[Row]) -> str:
    """A table for people."""

    def number(value: Optional[float]) -> str:
        return "-" if value is None else f"{value:.1f}"

    lines = ["| event | flight s | ours s | took s | |", "| --- | --- | --- | --- | --- |"]
    for row in rows:
        took = f"{number(row.took_s)} after {row.after}" if row.took_s is not None else "-"
        lines.append(f"| {row.event} | {number(row.flight_s)} | {number(row.ours_s)} | {took} | {row.fault} |")
    return "\n".join(lines)


def main(words: list[str]) -> int:
    """0: as expected; 1: not; 2: bad input."""
    if len(words) != 2:
        print("usage: python3 -m liana.timeline REPORT TIMELINE", file=sys.stderr)
        return 2
    try:
        report, timeline = (json.loads(pathlib.Path(word).read_text(encoding="utf-8")) for word in words)
        rows = compare(report, timeline)
    except (OSError, ValueError, KeyError) as error:
        print(f"liana.timeline: {error}: give a report of `liana run --json` and a timeline", file=sys.stderr)
        return 2
    print(text(rows))
    return 1 if any(row.fault for row in rows) else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
