"""The slit crossing, fast mode: seeds 1 to 10 nominal, 1 to 3 ideal, 1 to 3 worn; 1 to 5 nominal by lively hands."""
import json
import pathlib
import shutil
import subprocess
import sys
import tempfile
import time

import folders  # noqa: F401
from liana.recordings import Truth
from page import table

RUNS = [("nominal", "gentle", seed) for seed in range(1, 11)]
RUNS += [(physics, "gentle", seed) for physics in ("ideal", "worn") for seed in range(1, 4)]
RUNS += [("nominal", "lively", seed) for seed in range(1, 6)]
DEG_PER_RAD = 57.29577951308232


def planar_error_deg(recording):
    """Largest true angle of what the steered steps hold at 0 (X5, then X4 and X5) while the tip is past the slit's
    mouth.
    """
    truth = Truth(recording / "truth.bin")
    slit = json.loads((recording / "scene.json").read_text())["slit"]
    tip = [truth.column(f"tip_{axis}_m") for axis in "xyz"]
    inside = [sum(u * x for u, x in zip(slit["u_axis"], position)) > slit["mouth_u_m"] for position in zip(*tip)]
    steps = json.loads((recording / "mission.json").read_text())["steps"]
    held = [
        (range(step["start_tick"], step["end_tick"]), truth.column(f"theta_deg_{theta}"))
        for step in steps
        if step["device"] == "hand"
        for theta in step["held_theta"]
    ]
    return max((abs(angles[i]) for ticks, angles in held for i in ticks if inside[i]), default=0.0)


def run_once(binaries, directory, physics, temper, seed):
    """One run; its report with wall time and exit code added."""
    recording = pathlib.Path(directory) / f"{physics}-{temper}-{seed}"
    file = recording.with_suffix(".json")
    start = time.monotonic()
    words = [
        "--physics",
        physics,
        "--temper",
        temper,
        "--seed",
        str(seed),
        "--json",
        str(file),
        "--record",
        str(recording),
    ]
    call = [str(binaries / "liana"), "run", "slit_crossing", *words]
    done = subprocess.run(call, capture_output=True, text=True, check=False)
    report = json.loads(file.read_text()) if file.exists() else {"outcome": "no report"}
    report.update(physics=physics, temper=temper, seed=seed, exit_code=done.returncode, wall_s=time.monotonic() - start)
    if report["outcome"] == "success":
        report["planar_error_deg"] = planar_error_deg(recording)
    shutil.rmtree(recording, ignore_errors=True)
    print(f"   {physics} {temper} {seed}: {report['outcome']}, {report['wall_s']:.0f} s", file=sys.stderr, flush=True)
    return report


def scaled(report, key, factor, digits):
    return f"{report[key] * factor:.{digits}f}" if key in report else "-"


def row(report):
    tension = report.get("cable_tension_N", {})
    return [
        report["physics"],
        report["temper"],
        report["seed"],
        report["outcome"],
        scaled(report, "duration_s", 1, 1),
        scaled(report, "tip_error_m", 1e3, 2),
        scaled(report, "tip_attitude_error_rad", DEG_PER_RAD, 3),
        scaled(report, "open_loop_tip_error_m", 1e3, 1),
        scaled(report, "planar_error_deg", 1, 3),
        scaled(report, "min_slit_clearance_m", 1e3, 1),
        scaled(report, "min_sphere_clearance_m", 1e3, 0),
        scaled(report, "max_contact_force_N", 1, 2),
        scaled(tension, "min", 1, 1),
        scaled(tension, "min_motor", 1, 1),
        scaled(tension, "max", 1, 1),
        scaled(report, "wall_s", 1, 0),
    ]


HEAD = [
    "physics",
    "hands",
    "seed",
    "outcome",
    "arm time s",
    "tip mm",
    "tip deg",
    "open loop mm",
    "X4, X5 deg",
    "slit mm",
    "sphere mm",
    "contact N",
    "tension min N",
    "at motor N",
    "max N",
    "wall s",
]


def succeeded(reports, temper):
    these = [report["outcome"] == "success" for report in reports if report["temper"] == temper]
    return f"{sum(these)} of {len(these)}"


def measure(binaries):
    with tempfile.TemporaryDirectory(prefix="liana-numbers-") as directory:
        reports = [run_once(binaries, directory, *one) for one in RUNS]
    text = (
        f"{succeeded(reports, 'gentle')} runs by gentle hands succeeded, {succeeded(reports, 'lively')} by lively ones"
        " (docs/explanation/operator-model.md). Clearances, forces, tensions and errors are the physics' truth.\n\n"
    )
    whys = [
        f"\n- {report['physics']} {report['temper']} {report['seed']}: {report.get('reason', 'no report')}"
        for report in reports
        if report["outcome"] != "success"
    ]
    text += table(HEAD, [row(report) for report in reports])
    return reports, text + ("\n" + "".join(whys) if whys else "")
