"""What scenarios on every kind of bus share: reading their files, refusing bad ones, and saying why one failed."""
import json


class BadScenario(Exception):
    pass


class Failed(Exception):
    pass


def read(path):
    """The JSON object in a scenario's file."""
    try:
        content = json.loads(path.read_text())
    except ValueError as error:
        raise BadScenario(f"{path}: is not JSON: {error}") from None
    if not isinstance(content, dict):
        raise BadScenario(f"{path.parent.name}/{path.stem}: must be a JSON object")
    return content


def check_fields(name, found, allowed, required, readme="hil/scenarios/README.md"):
    for key, value in found.items():
        if key not in allowed:
            raise BadScenario(f"{name}: {key} is not known; allowed are {', '.join(allowed)}")
        if not isinstance(value, allowed[key]) or (allowed[key] is int and isinstance(value, bool)):
            raise BadScenario(f"{name}: {key} is {json.dumps(value)}, of the wrong type; see {readme}")
    for key in required:
        if key not in found:
            raise BadScenario(f"{name}: {key} is missing; add it")


def expect_that(condition, message):
    if not condition:
        raise Failed(message)
