"""An environment for learning, in the manner of Gymnasium, which is not needed: a simulated arm in virtual time.

The arm brings its tip to a place that is drawn by seed, as fast as verification lets it. The same seed and the same
actions give the same numbers, whatever the machine does besides.
"""
from __future__ import annotations

import json
import math
import random
from types import TracebackType
from typing import Any, NamedTuple, Optional, Sequence

from liana.client import Client, LianaError, Message
from liana.system import DEFAULT_ROBOT, System, table

Observation = tuple[float, ...]
Info = dict[str, Any]

STATE_S = 0.02  # between two states
TIP_SPEED = "tip_speed_m_s"  # of a robot table's limits
PLACE = slice(0, 3)  # of a pose


class Box(NamedTuple):
    """What values may be: each from `low` to `high`. `gymnasium.spaces.Box(np.array(box.low), np.array(box.high))` makes
    Gymnasium's of it."""

    low: tuple[float, ...]
    high: tuple[float, ...]

    @property
    def shape(self) -> tuple[int]:
        return (len(self.low),)

    def contains(self, values: Sequence[float]) -> bool:
        """False for numbers that are not finite, too."""
        return len(values) == len(self.low) and all(a <= x <= b for a, x, b in zip(self.low, values, self.high))

    def sample(self, draw: random.Random) -> tuple[float, ...]:
        return tuple(draw.uniform(a, b) for a, b in zip(self.low, self.high))


class BenchEnvironment:
    """A simulated arm whose tip is to reach a place.

    Action: velocity of the tip along x, y, z of the base, in m/s; the attitude stays.
    Observation: measured angles (deg), the tip's measured place x, y, z (m), the goal's x, y, z (m); all in the base
    frame. `observation_names` has a name with unit for each.
    Reward of a step: minus the distance from tip to goal after it (m).
    Terminated: the tip is within `tolerance_m` of the goal, or the arm has a fault. Truncated: `limit_steps` are over.
    Info: `time_s` of arm time, `distance_m`, `refused` (why the last action was not carried out, empty else), `faults`,
    and `ik`: `singular`, `limited` or `unreachable` where the tip cannot go on (docs/reference/api.md).
    """

    metadata: dict[str, Any] = {"render_modes": []}
    render_mode = None

    def __init__(
        self,
        robot: str = DEFAULT_ROBOT,
        scene: str = "none",
        step_s: float = 0.1,
        goal_m: float = 0.03,
        tolerance_m: float = 0.002,
        limit_steps: int = 100,
        **system: Any,
    ) -> None:
        """`step_s`: arm time of an action, 0.04 to 0.4 s; `goal_m`: distance of goals from the tip at first; `system`:
        what System takes besides."""
        for name, value, low, high in (
            ("step_s", step_s, 2 * STATE_S, 0.4),  # within 0.5 s of the fastest way, as servo_cp wants it
            ("goal_m", goal_m, 0.001, 1.0),
            ("tolerance_m", tolerance_m, 1e-5, 1.0),
            ("limit_steps", limit_steps, 1, 1000000),
        ):
            if not low <= value <= high:
                raise LianaError(f"{name}: {value}: allowed {low:g} to {high:g}")
        self.step_s, self.goal_m, self.tolerance_m, self.limit_steps = step_s, goal_m, tolerance_m, limit_steps
        self._words: dict[str, Any] = {"robot": robot, "scene": scene, **system}
        content = json.loads(table("robot", robot))
        angles = len(next(iter(content["named_poses_deg"].values())))
        speed_m_s = content["limits"][TIP_SPEED] / math.sqrt(3.0)
        self.action_space = Box((-speed_m_s,) * 3, (speed_m_s,) * 3)
        endless = (math.inf,) * (angles + 6)
        self.observation_space = Box(tuple(-x for x in endless), endless)
        self.observation_names = [f"measured_js_deg_{i}" for i in range(1, angles + 1)]
        self.observation_names += [f"{what}_{axis}_m" for what in ("tip", "goal") for axis in "xyz"]
        self.goal: tuple[float, ...] = ()
        self._draw = random.Random()
        self._system: Optional[System] = None
        self._client: Optional[Client] = None
        self._target: list[float] = []  # what the tip was asked for last
        self._steps = 0
        self._refused = ""

    def __enter__(self) -> BenchEnvironment:
        return self

    def __exit__(
        self, kind: Optional[type[BaseException]], error: Optional[BaseException], trace: Optional[TracebackType]
    ) -> None:
        self.close()

    def reset(self, *, seed: Optional[int] = None, options: Optional[Info] = None) -> tuple[Observation, Info]:
        """Starts a new simulated arm, enabled in its start pose, with a new goal. `seed`: of goal and simulator, 0 to
        2^31 - 1; where none is given the next one is drawn. `options`: `goal_m`, a place for the goal [x, y, z]."""
        given = dict(options or {})
        place = given.pop("goal_m", None)
        if given:
            raise LianaError(f"options: {', '.join(given)}: allowed goal_m")
        if seed is not None:
            if not 0 <= seed < 1 << 31:
                raise LianaError(f"seed: {seed}: allowed 0 to {(1 << 31) - 1}")
            self._draw = random.Random(seed)
        self.close()
        words: dict[str, Any] = {"seed": self._draw.randrange(1, 1 << 31), **self._words}
        self._system = System(**words)
        self._system.__enter__()
        self._client = self._system.client("environment")
        state = self._client.enable()
        self._target, self._steps, self._refused = list(state["setpoint_cp"]), 0, ""
        self.goal = self._place(place) if place is not None else self._drawn_goal()
        return self._observation(state), self._info(state)

    def step(self, action: Sequence[float]) -> tuple[Observation, float, bool, bool, Info]:
        """Moves the tip at this velocity for `step_s`: observation, reward, terminated, truncated, info. LianaError for an
        action outside of `action_space`, which is never cut to it."""
        velocity_m_s = [float(value) for value in action]
        if not self.action_space.contains(velocity_m_s):
            raise LianaError(
                f"action: {velocity_m_s}: allowed are 3 numbers, each -{self.action_space.high[0]:g} to "
                f"{self.action_space.high[0]:g} m/s"
            )
        client = self._connected()
        before = list(self._target)
        for i, speed_m_s in enumerate(velocity_m_s):
            self._target[i] += speed_m_s * self.step_s
        number = client.request("servo_cp", goal=self._target)
        state = client.go_on(self.step_s)
        answer = client.answers.pop(number, {"op": "ok"})
        verdict, self._refused = state["verdict"], ""
        if answer["op"] != "ok":
            self._target, self._refused = before, f"{answer['code']}: {answer['message']}"
        elif verdict["code"] != 0:
            self._refused = f"{verdict['code']} {verdict['name']}"
        self._steps += 1
        info = self._info(state)
        terminated = info["distance_m"] <= self.tolerance_m or bool(info["faults"])
        return self._observation(state), -info["distance_m"], terminated, self._steps >= self.limit_steps, info

    def render(self) -> None:
        """Draws nothing; `liana view` shows recordings."""

    def close(self) -> None:
        """Ends the simulated arm, if there is one."""
        if self._system is not None:
            self._system.__exit__(None, None, None)
        self._system = self._client = None

    def _connected(self) -> Client:
        if self._client is None:
            raise LianaError("there is no arm: call reset() first")
        return self._client

    def _place(self, place: Sequence[float]) -> tuple[float, ...]:
        found = tuple(float(value) for value in place)
        if len(found) != 3 or not all(map(math.isfinite, found)):
            raise LianaError(f"options: goal_m: {found}: allowed are 3 finite numbers in metres")
        return found

    def _drawn_goal(self) -> tuple[float, ...]:
        """`goal_m` away from the tip, in any direction."""
        way = [self._draw.gauss(0.0, 1.0) for _ in range(3)]
        size = math.hypot(*way)
        return tuple(x + self.goal_m * part / size for x, part in zip(self._target[PLACE], way))

    def _observation(self, state: Message) -> Observation:
        return (*state["measured_js_deg"], *state["measured_cp"][PLACE], *self.goal)

    def _info(self, state: Message) -> Info:
        distance_m = math.dist(state["measured_cp"][PLACE], self.goal)
        faults = [f"{fault['number']} {fault['name']}" for fault in state["faults"]]
        found = {"time_s": state["time_s"], "distance_m": distance_m, "refused": self._refused, "faults": faults}
        return {**found, "ik": state["ik"]["outcome"]}
