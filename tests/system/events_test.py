"""Why something happened: the same events in the topic, the file and the recording of a run, numbered without gaps."""
import json
import pathlib
import re
import tempfile
import unittest

from support import MISSIONS, SystemTest, start_run
from liana.recordings import Mcap, read_events
from liana.system import System, run, table

DRIVE, FAULT_SLOT = 3, 4000
STEP = {"index": 2, "name": "around the obstacle", "device": "none"}
FULL_QUEUE = [{"action": "refuse", "bus": 0, "count": 1, "from_slot": 2000, "to_slot": 2010}]


def columns(event):
    """An event of the topic or of a recording as a line of the file has it."""
    names = ("sequence", "tick", "kind", "number", "subject", "text", "values")
    return {name: event[name] for name in names}


class EventsOfARun(SystemTest):
    """Two systems in which everything happens that can, and what is left of them."""

    @classmethod
    def setUpClass(cls):
        keeper = cls()
        cls.addClassCleanup(keeper.doCleanups)
        cls.client, cls.file, cls.recorded, cls.log = keeper.eventful_run()
        cls.states = cls.client.told
        cls.unbooted = keeper.run_without_a_drive()

    def runTest(self):
        """Lets setUpClass make an instance whose clean-ups outlive single tests."""

    def eventful_run(self):
        faults = [{"drive": DRIVE + 1, "kind": "fault", "at_slot": FAULT_SLOT}]
        system = self.enterContext(System("client,archive", faults=faults, bus_script=FULL_QUEUE))
        system.start_archive()
        client = system.client()
        client.told = []
        mission, operator = (system.client(role, role, lockstep=False) for role in ("mission", "operator"))
        client.enable()
        mission.request("announce", step=STEP)
        operator.request("operator_says", what="arrived")
        client.call("tool", command="weld")
        client.ask("move_jp", goal_deg=[1, 2, 3])
        here_deg = client.state["setpoint_js_deg"]
        client.call("move_path", points_deg=[here_deg, [angle + 0.1 for angle in here_deg]])
        client.until(lambda state: any("path" in event["text"] for event in state["events"]) and not state["is_busy"])
        for _ in range(100):
            client.request("mission_control", command="resume")
        client.go_on(0.1)
        client.start_moving()
        client.told.append(client.until(lambda state: state["faults"]))
        client.told.append(client.until(lambda state: state["state"] == "FAULT"))
        client.go_on(1.0)
        client.call("state_command", command="clear")
        client.told.append(client.until(lambda state: state["state"] == "DISABLED" and not state["faults"]))
        operator.request("stop", reason="enough")
        client.told.append(client.until(lambda state: state["stop"]))
        operator.close()
        client.call("release")
        client.told.append(client.go_on(0.1))
        system.end_lianad(client)
        self.assertEqual([system.ended(name) for name in ("lianad", "liana-archive")], [0, 0])
        recorded = Mcap(system.directory / "state.mcap")
        return client, system.events(), recorded, system.log("liana-archive")

    def run_without_a_drive(self):
        with System(faults=[{"drive": DRIVE + 1, "kind": "missing", "at_slot": 0}]) as system:
            client = system.client()
            client.until(lambda state: state["state"] == "FAULT")
            system.shut_down(client)
            return system.events()

    def told(self, kind):
        return [event for event in self.file if event.kind == kind]

    def test_their_numbers_have_no_gaps_and_their_ticks_never_fall(self):
        for events in (self.file, self.unbooted):
            self.assertEqual([event.sequence for event in events], list(range(1, len(events) + 1)))
            ticks = [event.tick for event in events]
            self.assertEqual(ticks, sorted(ticks))
        self.assertEqual(self.client.events_lost, 0)

    def test_topic_file_and_recording_tell_the_same(self):
        file = [columns(event._asdict()) for event in self.file]
        recorded = [columns(message.json()) for message in self.recorded.messages("event")]
        self.assertEqual(recorded, file)
        heard = [columns(event) for event in self.client.events]
        self.assertEqual(heard, file[: len(heard)])
        self.assertGreater(len(heard), len(file) - 3)
        self.assertEqual(self.recorded.metadata["end"], {"events": str(len(file)), "events_lost": "0"})
        self.assertIn("0 events lost", self.log)

    def test_every_kind_but_five_happens_and_is_valid_against_the_schema(self):
        schema = json.loads(self.recorded.channels["event"].schema)
        kinds = set(schema["properties"]["kind"]["enum"])
        happened = {event.kind for event in self.file + self.unbooted}
        # service_events_test, way_out_test, friction_watch_test, service_test
        elsewhere = {"verdict", "retract", "friction", "device", "load_cell"}
        self.assertEqual(kinds - happened, elsewhere)
        for message in self.recorded.messages("event"):
            self.assertEqual(set(message.json()), set(schema["required"]))
            self.assertIn(message.json()["kind"], kinds)

    def test_an_event_says_number_subject_and_values(self):
        (fault,) = self.told("fault")
        self.assertEqual(
            (fault.number, fault.subject, fault.values["detail"]), (3003, "drive 4 (node 4, segment 2)", 0x2310)
        )
        self.assertLessEqual(abs(fault.values["tick"] - FAULT_SLOT), 5)
        (emergency,) = [event for event in self.told("emergency") if event.number != 0]
        self.assertEqual((emergency.number, emergency.subject), (0x2310, "drive 4 (node 4, segment 2)"))
        (stop,) = self.told("stop")
        self.assertEqual((stop.number, stop.subject), (2, "operator"))
        self.assert_names(stop.text, "emergency stop", "operator", "enough")
        (step,) = self.told("step")
        self.assertEqual((step.number, step.subject), (2, STEP["name"]))
        (refusal,) = self.told("refusal")
        self.assertEqual((refusal.number, refusal.subject), (1, "test"))
        self.assertIn("goal_deg", refusal.text)
        self.assertEqual([(event.number, event.subject) for event in self.told("owner")], [(1, "test"), (2, "test")])
        begins, arrives = self.told("path")
        self.assertEqual((begins.number, arrives.number), (1, 2))
        self.assertEqual(begins.subject, arrives.subject)
        self.assertRegex(begins.subject, "^[0-9a-f]{64}$")
        self.assertLess(begins.values["share"], 0.1, "its first interval has begun")
        self.assertEqual(arrives.values["share"], 1)
        (clear,) = self.told("clear")
        self.assertEqual(clear.number, 0)
        self.assertGreater(clear.values["checked"], 0)
        trouble = self.told("host_warning")
        self.assertEqual([(event.number, event.subject) for event in trouble], [(4, "bus can0"), (5, "bus can0")])
        self.assertEqual(trouble[1].values, {"count": 1})
        (missing,) = [event for event in self.unbooted if event.kind == "boot_problem"]
        self.assertEqual(
            (missing.number, missing.subject, missing.values), (3001, "drive 4 (node 4, segment 2)", {"drive": 4})
        )

    def test_who_floods_is_counted(self):
        (left_out,) = self.told("left_out")
        self.assertEqual(left_out.subject, "operator")
        said = self.told("operator")
        self.assertLess(len(said), 15)
        self.assertEqual(sum(event.values.get("times", 1) for event in said) + left_out.number, 101)

    def test_a_state_shows_tick_and_text_of_the_newest_ten_without_what_it_tells_elsewhere(self):
        elsewhere = {("owner", 1), ("homing", 1)}
        shown = [
            {"tick": event.tick, "text": event.text}
            for event in self.file
            if event.kind not in ("fault", "boot_problem", "refusal", "operator")
            and (event.kind, event.number) not in elsewhere
        ]
        for state in self.states:
            seen = state["events"]
            end = shown.index(seen[-1]) + 1
            while seen != shown[max(0, end - 10) : end]:
                end += 1
                self.assertLessEqual(end, len(shown), seen)


class WhatStands(SystemTest):
    # req:C12
    def test_a_plug_that_was_loose_for_a_moment_is_told_once_for_as_long_as_it_takes(self):
        silent = [{"drive": "all", "kind": "silent", "at_slot": 1500, "for_slots": 100}]  # 0.4 s
        with System(faults=silent) as system:
            client = system.client()
            client.enable()
            client.until(lambda state: state["faults"])
            client.go_on(130.0)
            system.shut_down(client)
            events = system.events()
        since = [event for event in events if event.tick > 1500]
        self.assertLess(len(since), 60, [event.text for event in since])
        cause = next(event for event in since if event.kind == "fault")
        self.assertLess(cause.tick, 1600)
        counted = [event for event in since if "times" in event.values]
        for event in counted:
            self.assertGreaterEqual(event.values["times"], 1)
            self.assertLessEqual(event.values["last_tick"], event.tick)
        self.assertEqual([event.sequence for event in events], list(range(1, len(events) + 1)))

    def test_a_client_that_is_refused_again_and_again_is_told_ten_times_and_counted(self):
        with System() as system:
            client = system.client()
            client.until(lambda state: state["is_homed"])
            for i in range(300):
                self.assert_refused(client.ask("move_jp", goal_deg=[i]), "not_owner")
            client.go_on(3.0)
            system.shut_down(client)
            refused = [event for event in system.events() if event.kind == "refusal"]
            requests = [line for line in open(system.directory / "commands.txt") if "\trequest\t" in line]
        self.assertLess(len(refused), 15)
        self.assertEqual(sum(event.values.get("times", 1) for event in refused), 300)
        self.assertLess(len(requests), 15)


class EventsOfRunsThatFail(SystemTest):
    def test_the_last_message_names_the_file_which_says_why(self):
        folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))
        script = folder / "goes_wrong.lua"
        wrong = 'arm.move_jp { goal_deg = arm.named_pose "nowhere" }'
        script.write_text((MISSIONS / "goes_wrong.lua").read_text().replace("-- WHAT GOES WRONG", wrong))
        process = start_run(self, script)
        _, error = process.communicate(timeout=300)
        self.assertEqual(process.returncode, 1, error)
        named = re.search(r"(\S+/events\.txt)\b", error)
        self.assertIsNotNone(named, error)
        events = read_events(named.group(1))
        self.assertEqual([event.text for event in events if event.kind == "step"][0], "step 1: begin to move")
        self.assertIn("owner", {event.kind for event in events})
        kinds = [event.kind for event in events]
        self.assertEqual(set(kinds[kinds.index("shutdown") :]), {"shutdown", "client", "device"}, "all leave after it")

    def test_a_folder_where_no_events_can_be_written_is_refused_before_anything_moves(self):
        folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))
        tables = []
        for kind, name in (("robot", "zhu2022"), ("scene", "panel_slit"), ("buses", "embedded")):
            (folder / kind).write_text(table(kind, name))
            tables += [f"--{kind}", folder / kind]
        done = run("lianad", *tables, "--api", folder / "api", "--events", "/nonexistent/events.txt")
        self.assertEqual(done.returncode, 2)
        self.assertIn("--events: '/nonexistent/events.txt'", done.stderr)

    def test_a_full_disk_is_trouble_of_the_host_and_the_arm_goes_on(self):
        with System(events="/dev/full") as system:
            client = system.client()
            client.enable()
            client.until(lambda state: any("No space left on device" in event["text"] for event in state["events"]))
            client.start_moving()
            client.until(lambda state: not state["is_busy"])
            self.assert_holds(client.state)
            (trouble,) = [event for event in client.events if event["kind"] == "host_warning"]
            self.assertEqual((trouble["number"], trouble["subject"]), (7, "/dev/full"))


if __name__ == "__main__":
    unittest.main(verbosity=2)
