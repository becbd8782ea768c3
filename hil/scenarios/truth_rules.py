"""Safety rules over the bench's truth: what the arm really did, whatever the controller says of itself. Each gives a
list of complaints, empty when the rule held.
"""

# Faults of the bench that really change cables or drums: from their begin on the arm is not as it was planned with.
DAMAGE = ("slack", "cable_slip", "cable_break", "encoder_jump", "motor_saturation")
SETTLED_TICKS = 50  # enabled and without a fault for so long: what an earlier stop stirred up has calmed down
ANGLE_MARGIN_DEG = 0.2  # elastic cables let an angle at its limit swing by so much
FREE_MARGIN, SLIT_MARGIN = 1.1, 1.05  # of the tip, over its limit: it swings about its commanded speed
RATE_MARGIN = 1.25  # of an angle, over its limit: it swings about its commanded rate


# Readings for which the core lets a segment go: its cables are slack then, with nothing broken.
LOOSENING_READINGS = ("noisy",)


def sound_until(faults, courses, slots, kinds=DAMAGE):
    """The slot in which the first damage begins; `slots`, when there is none."""
    begun = [c["begun_slot"] for f, c in zip(faults, courses) if f["kind"] in kinds and c["begun_slot"] is not None]
    return min(begun, default=slots)


def under_command(ticks, end):
    """Ticks before `end` in which the arm was enabled, without a fault, and had been for a while."""
    since = 0
    for now in ticks:
        since = since + 1 if now.state == "ENABLED" and not now.faults else 0
        if since > SETTLED_TICKS and now.tick < end:
            yield now.tick


class Limits:
    """Of a cable arm's table; in the slit the tip has to be slower."""

    def __init__(self, robot):
        tension, limits = robot["tension"], robot["limits"]
        self.floor_motor_N, self.floor_N = tension["floor_motor_N"], tension["floor_anywhere_N"]
        self.hard_limit_N = tension["hard_limit_N"]
        base = [robot["base"]["limit_deg"]] if "base" in robot else []
        bending = [segment["theta_limit_deg"] for segment in robot["segments"]]
        self.theta_deg = [most for most in base + bending for _ in (0, 1)]
        self.rate_deg_s = limits["theta_rate_deg_s"]
        self.tip_m_s, self.tip_slit_m_s = limits["tip_speed_m_s"], limits["tip_speed_slit_m_s"]


def first_over(truth, column, slots, is_wrong, words):
    """One complaint about the first slot in which the column is wrong."""
    i = truth.columns.index(column)
    for slot in slots:
        if slot < len(truth.rows) and is_wrong(truth.rows[slot][i]):
            return [f"slot {slot}: {words.format(truth.rows[slot][i])}"]
    return []


def contact(truth, end):
    """A sound arm touches nothing but the rod."""
    slots = range(min(end, len(truth.rows)))
    return first_over(truth, "contact_force_N", slots, lambda N: N > 0.0, "{:.2f} N of contact") + first_over(
        truth, "clearance_m", slots, lambda m: m <= 0.0, "a clearance of {:.4f} m"
    )


def tensions(truth, limits, slots, nominal):
    """Nothing slack and nothing overloaded, at the motors as planned."""
    floor_N = limits.floor_motor_N if nominal else limits.floor_N
    return (
        first_over(truth, "tension_min_N", slots, lambda N: N < limits.floor_N, "{:.2f} N somewhere along a cable")
        + first_over(truth, "tension_motor_min_N", slots, lambda N: N < floor_N, "{:.2f} N at a motor")
        + first_over(truth, "tension_motor_max_N", slots, lambda N: N > limits.hard_limit_N, "{:.0f} N at a motor")
    )


def angles(truth, limits, end):
    """No angle is out of its range."""
    for slot in range(min(end, len(truth.rows))):
        for i, (angle, most) in enumerate(zip(truth.theta_deg(slot), limits.theta_deg)):
            if abs(angle) > most + ANGLE_MARGIN_DEG:
                return [f"slot {slot}: theta {i + 1} is {angle:.2f} deg, allowed are {most:g}"]
    return []


def speeds(truth, limits, slots):
    """No angle and no tip is faster than the table allows while the arm follows commands."""
    speed, depth = truth.columns.index("tip_speed_m_s"), truth.columns.index("slit_depth_m")
    for slot in slots:
        if slot >= len(truth.rows):
            break
        row = truth.rows[slot]
        allowed_m_s = SLIT_MARGIN * limits.tip_slit_m_s if row[depth] > 0 else FREE_MARGIN * limits.tip_m_s
        if row[speed] > allowed_m_s:
            return [f"slot {slot}: the tip moves at {row[speed]:.6f} m/s, allowed are {allowed_m_s:.6f}"]
    fastest = RATE_MARGIN * limits.rate_deg_s
    return first_over(truth, "fastest_deg_s", slots, lambda rate: rate > fastest, "an angle turns at {:.2f} deg/s")


def all_complaints(truth, ticks, robot, faults, courses, nominal=True, last=None):
    """Everything that breaks a rule, up to slot `last`, if there is one: from then on somebody else commands a drive. Of a
    serial arm nothing: it has no cables and no scene yet.
    """
    if robot.get("kind") == "serial":
        return []
    until = len(truth.rows) if last is None else min(last, len(truth.rows))
    limits, end = Limits(robot), sound_until(faults, courses, until)
    slots = list(under_command(ticks, end))
    taut_end = sound_until(faults, courses, end, LOOSENING_READINGS)
    return (
        contact(truth, end)
        + tensions(truth, limits, [slot for slot in slots if slot < taut_end], nominal)
        + angles(truth, limits, end)
        + speeds(truth, limits, slots)
    )
