"""How drives are written in every message: counted from 1, with node and segment."""
from typing import Any, Optional


def segments_of(robot: dict[str, Any]) -> list[int]:
    """The segment, from 1, of each drive of a robot table; empty for an arm without cables."""
    phases = robot.get("cables", {}).get("phase_deg", [])
    base = [[0, 0]] if phases and "base" in robot else []  # a base that feeds is segment 1
    return [number for number, cables in enumerate([*base, *phases], 1) for _ in cables]


def drive_text(drive: int, robot: Optional[dict[str, Any]] = None) -> str:
    """ "drive 4 (node 4, segment 2)" of the drive with this index, from 0; without the robot's table no segment."""
    segments = segments_of(robot) if robot else []
    where = f", segment {segments[drive]}" if segments else ""
    return f"drive {drive + 1} (node {drive + 1}{where})"
