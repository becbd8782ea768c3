"""The embedded bus in virtual time, in lockstep, with faults of bench and bus; judged by truth, logs and recording."""
import arms
import predicates
import torque_rules
import trial
import wire_checks
from liana.system import System
from scenario_file import expect_that
from stand import Stand

MOVE_DEG = 6.0
PATH_STOP = 500  # ticks; twice what rest from full speed takes
TRAVEL_DEG = 1.0  # of any angle from the fault to the end, where a scenario says nothing else
JOINT = arms.ARMS[arms.CABLE_ARM].joint
START_POSE = "prepare"  # of every arm whose scenario names none


class EmbeddedStand(Stand):
    faults_are_scheduled = True

    def __init__(self, robot=arms.CABLE_ARM):
        self.robot = robot

    def start(self, scenario):
        faults, script = scenario.faults, scenario.bus_script
        words = {**scenario.words(), **arms.tables(self.robot)}
        if "--start-pose" not in words["bench"]:
            words["bench"] = ["--start-pose", START_POSE, *words["bench"]]
        return System(expect="client,archive", faults=faults, bus_script=script, **words)

    def client(self, system):
        system.start_archive()
        return system.client()

    def start_move(self, client):
        start_move(client, arms.ARMS[self.robot].joint)

    def judge(self, run, system, client):
        judge_run(run, system)
        judge_wire(run, system)
        scenario = run.scenario
        recorded = trial.Trial(scenario.faults or [], scenario.bus_script or [], cause_tick=scenario.cause_tick)
        recorded.judge(system, client.faults_told)
        run.violations += recorded.complaints


def start_move(client, joint=JOINT):
    """A move of one angle (from 0; the ninth theta) that lasts some seconds; does not wait for it to begin."""
    goal_deg = list(client.state["setpoint_js_deg"])
    goal_deg[joint] -= MOVE_DEG
    client.call("move_jp", goal_deg=goal_deg)


def begun(scenario, system):
    """The slot in which the first fault began; 0 without one."""
    if scenario.cause_tick is not None:
        return scenario.cause_tick
    courses = system.json("bench_summary.json")["faults"]
    missing = [course["kind"] for course in courses if course["begun_slot"] is None]
    expect_that(not missing, f"never began: {', '.join(missing)}")
    slots = [course["begun_slot"] for course in courses] + [rule["from_slot"] for rule in scenario.bus_script or []]
    return min(slots, default=0)


def traffic_of(scenario, system, robot, period_s):
    """What was said on the buses, but for those in whose name a stranger spoke."""
    kind = torque_rules.TorqueTraffic if torque_rules.gives_torque(robot) else predicates.Traffic
    traffic = kind([path.read_text() for path in system.bus_logs()], period_s)
    for node in scenario.strangers_nodes():
        traffic.commands.pop(node, None), traffic.reports.pop(node, None)
    expect_that(
        scenario.during == "boot" or traffic.commands, "no command on the wire: the rules had nothing to look at"
    )
    return traffic


def judge_run(run, system):
    """Detection in time, a stop in time, and no travel; targets in bounds whatever happened."""
    first, truth = begun(run.scenario, system), system.truth()
    period_s = 1.0 / system.json("buses.json")["rate_hz"]
    robot = system.json("robot.json")
    traffic = traffic_of(run.scenario, system, robot, period_s)
    run.violations += commands_out_of_bounds(traffic, robot, period_s)
    if "refused" in run.expect:
        run.violations += predicates.drives_with_torque(truth.column("enabled"), 0, run.end)
    if run.latched is None:
        return
    run.judge_delay(first)
    end = run.enabled_again or run.end
    if not run.expect.get("late_commands"):  # those come whenever the wire does, with what was wanted before
        run.violations += commands_that_move(traffic, robot, run.latched + PATH_STOP, end)
    if run.expect["state"] == "FAULT":
        judge_stop(run, truth, traffic, end, robot)
    travel_deg, allowed_deg = truth.travel_deg(first, end), run.expect.get("travel_deg", TRAVEL_DEG)
    run.notes.append(f"travel {travel_deg:.3f} deg")
    expect_that(travel_deg <= allowed_deg, f"the arm travelled {travel_deg:.2f} deg, allowed are {allowed_deg}")


def commands_out_of_bounds(traffic, robot, period_s):
    if torque_rules.gives_torque(robot):
        return torque_rules.told(traffic, robot, period_s)
    step_counts, jump_counts = predicates.step_limit_counts(robot, period_s), predicates.let_go_counts(robot)
    return predicates.target_steps(traffic, step_counts, jump_counts)


def commands_that_move(traffic, robot, first_slot, end_slot):
    if torque_rules.gives_torque(robot):
        return torque_rules.rates_while_latched(traffic, robot, first_slot, end_slot)
    return predicates.targets_that_move(traffic, first_slot, end_slot)


def judge_stop(run, truth, traffic, end, robot):
    """Torque off in time, and from then on nothing enables and no drum moves."""
    stopped = run.latched + run.expect.get("stopped_within_ticks", 0)
    enabled = truth.column("enabled")
    last = max((slot for slot in range(run.latched, end) if enabled[slot] > 0), default=run.latched)
    run.notes.append(f"without torque after {last - run.latched} ticks")
    nodes = [1 + drive for drive in trial.self_reporting(run.scenario.faults or [], len(traffic.reports))]
    run.violations += predicates.drives_with_torque(enabled, stopped, end)
    if not run.expect.get("late_commands"):  # those that waited in a transmit queue switch nothing on, as truth shows
        run.violations += predicates.enabling_without_clear(traffic, stopped, end)
    swing_counts = torque_rules.swing_counts(robot) if torque_rules.gives_torque(robot) else 1
    run.violations += predicates.drums_that_move(traffic, stopped, end, nodes, swing_counts)


def judge_wire(run, system):
    """As another decoder reads it."""
    for bus, log in zip(system.json("buses.json")["buses"], system.bus_logs()):
        frames = wire_checks.decoded(log)
        run.violations += wire_checks.malformed(log.name, frames)
        if run.expect.get("boot_order"):
            run.violations += [complaint for node in bus["nodes"] for complaint in wire_checks.boot_order(frames, node)]
