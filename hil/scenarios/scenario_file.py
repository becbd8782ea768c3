"""What scenarios on every kind of bus share: reading their files, refusing bad ones, and saying why one failed."""
import json
import math


class BadScenario(Exception):
    pass


class Failed(Exception):
    pass


def each_once(pairs):
    for i, (key, _) in enumerate(pairs):
        if key in [other for other, _ in pairs[:i]]:
            raise ValueError(f"{key} is there twice; leave one")
    return dict(pairs)


def not_finite(content, where=""):
    """The place of the first number that is none to compute with, as a[0].b; None where all are."""
    if isinstance(content, float) and not math.isfinite(content):
        return where
    steps = content.items() if isinstance(content, dict) else enumerate(content) if isinstance(content, list) else ()
    for step, value in steps:
        place = f"{where}[{step}]" if isinstance(content, list) else f"{where}.{step}".lstrip(".")
        found = not_finite(value, place)
        if found is not None:
            return found
    return None


def read(path):
    """The JSON object in a scenario's file."""
    beyond = []

    def number(text):
        value = float(text)
        if not math.isfinite(value):
            beyond.append(text)
        return value

    try:
        content = json.loads(path.read_text(), object_pairs_hook=each_once, parse_float=number, parse_constant=number)
    except ValueError as error:
        raise BadScenario(f"{path}: is no good JSON: {error}") from None
    if beyond:
        raise BadScenario(f"{path}: {not_finite(content)}: {beyond[0]}: allowed are finite numbers; correct it")
    if not isinstance(content, dict):
        raise BadScenario(f"{path.parent.name}/{path.stem}: must be a JSON object")
    return content


DURING = ("boot", "rest", "move")
TIME_LIMIT_S = 300  # wall clock
STATES = ("BOOTING", "DISABLED", "ENABLING", "ENABLED", "STOPPING", "FAULT")
# Numbers that mean something in a scenario of any kind: least and most.
RANGES = {
    "within_ticks": (0, 1e6),
    "stopped_within_ticks": (0, 1e6),
    "travel_deg": (0.0, 360.0),
    "time_limit_s": (0.1, 86400),
    "stop_after_s": (0.0, 60.0),
    "cause_tick": (0, 1e6),
    "index": (-1, 31),
    "fault": (1001, 6999),
    "overruns": (0, 1e6),
}


def check_values(name, found):
    for key, value in found.items():
        if key in ("state", "after_clear") and value not in STATES:
            raise BadScenario(f"{name}: {key} is {value}; allowed are {', '.join(STATES)}")
        if key not in RANGES or value is None:
            continue
        least, most = RANGES[key]
        for number in value if isinstance(value, list) else [value]:
            if not isinstance(number, (int, float)) or not least <= number <= most:
                raise BadScenario(f"{name}: {key} is {json.dumps(number)}; allowed are {least:g} to {most:g}")


def check_fields(name, found, allowed, required, readme="hil/scenarios/README.md"):
    for key, value in found.items():
        if key not in allowed:
            raise BadScenario(f"{name}: {key} is not known; allowed are {', '.join(allowed)}")
        if not isinstance(value, allowed[key]) or (allowed[key] is int and isinstance(value, bool)):
            raise BadScenario(f"{name}: {key} is {json.dumps(value)}, of the wrong type; see {readme}")
    for key in required:
        if key not in found:
            raise BadScenario(f"{name}: {key} is missing; add it")
    check_values(name, found)


def check_during(name, during):
    if during not in DURING:
        raise BadScenario(f"{name}: during is {during}; allowed are {', '.join(DURING)}")


def expect_that(condition, message):
    if not condition:
        raise Failed(message)
