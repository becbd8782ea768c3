"""Python client of Liana (docs/getting-started/python.md): lianad's API, systems of processes, recordings. Standard
library only.
"""
from liana.client import Client, ConnectionClosed, LianaError, NotReached, RequestRefused, TimedOut
from liana.devices import ArmState, Device
from liana.environment import BenchEnvironment
from liana.recordings import BadRecording, Event, Recording, Truth, read_events
from liana.system import ProgramMissing, ProgramRefused, System

__version__ = "0.4.0"  # as CMakeLists.txt has it; tests/host/apps/cli/test_version.py compares

__all__ = [
    "ArmState",
    "BadRecording",
    "BenchEnvironment",
    "Client",
    "ConnectionClosed",
    "Device",
    "Event",
    "LianaError",
    "NotReached",
    "ProgramMissing",
    "ProgramRefused",
    "Recording",
    "RequestRefused",
    "System",
    "TimedOut",
    "Truth",
    "read_events",
]
