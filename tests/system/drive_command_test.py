"""`liana drive`: one motor on a desk, with a bus and the bench's drives and nothing else."""
import json
import os
import pathlib
import shutil
import signal
import subprocess
import tempfile
import time
import unittest
import unittest.mock

from support import SystemTest
from liana.client import wait_until
from liana.system import System, program, run

COUNTS_OF_MICRO = 1048576  # of one turn of a motor
SWITCH_ON_DISABLED, FAULT, STATE = 0x40, 0x08, 0x4F  # statusword


class Desk(System):
    """Bus and bench alone: the command is the only master."""

    def __init__(self, bus="embedded_micro", robot="micro", time="fast", faults=None):
        super().__init__(bus=bus, robot=robot, scene="none", faults=faults)
        self.time = time

    def start_programs(self):
        self.start_bus()
        faults = self.optional("--faults", "faults")
        reports = self.reports_of_bench()
        self.start("liana-bench", *self.tables(), "--bus-socket", self.bus_socket, "--no-spread", *faults, *reports)

    def start_bus(self):
        if self.time == "fast":
            return super().start_bus()
        self.start(
            "liana-bus", "--socket", self.bus_socket, "--buses", self.directory / "buses.json", "--time", self.time
        )
        wait_until(self.bus_socket.exists, "liana-bus to listen", self.check_running)

    def where(self):
        return ["--bus", self.directory / "buses.json", "--bus-socket", self.bus_socket, "--time", self.time]

    def statusword_at_the_end(self, drive):
        """As the bench itself has it; it goes on for half a second after the bus has ended."""
        self.children["liana-bench"].wait(timeout=60)
        return json.loads((self.directory / "bench_summary.json").read_text())["drives"][drive]["statusword"]


class DriveCommand(SystemTest):
    def drive(self, *words, bus="embedded_micro"):
        """One command, on a bus of its own: the bus ends with its master."""
        with Desk(bus) as desk:
            return run("liana", "drive", *words, *desk.where())

    def test_scan_names_every_node_and_what_it_is(self):
        done = self.drive("scan", "--json")
        self.assertEqual(done.returncode, 0, done.stderr)
        found = json.loads(done.stdout)
        self.assertEqual(
            [(each["bus"], each["node"]) for each in found],
            [("can0", n) for n in (1, 2, 3, 4)] + [("can1", n) for n in (5, 6, 7)],
        )
        self.assertEqual({(each["vendor"], each["product"]) for each in found}, {(0x4C49, 2)})
        self.assertIn("has csp", self.drive("scan", "--first", "2", "--last", "2").stdout)

    def test_scan_names_the_second_axis_of_a_node(self):
        with Desk("embedded_two_axes", robot="zhu2022") as desk:
            done = run("liana", "drive", "scan", "--json", *desk.where())
        self.assertEqual(done.returncode, 0, done.stderr)
        found = json.loads(done.stdout)
        both = [node for node in range(1, 8) for _ in (1, 2)]
        self.assertEqual([each["node"] for each in found], [*both, 8])
        self.assertEqual([each["axis"] for each in found], [*[1, 2] * 7, 1])
        self.assertTrue(all(each["modes"] & 0x80 for each in found))

    def test_nobody_there_is_exit_code_3(self):
        self.assertEqual(self.drive("scan", "--first", "50", "--last", "60").returncode, 3)
        done = self.drive("read", "--node", "50", "1000")
        self.assertEqual(done.returncode, 3, done.stdout)
        self.assertIn("no answer within 1 s", done.stderr)

    def test_an_object_is_read_as_number_or_text_and_a_refusal_is_named(self):
        done = self.drive("read", "--node", "3", "6076", "--json")
        self.assertEqual((done.returncode, json.loads(done.stdout)["unsigned"]), (0, 150000), done.stderr)
        self.assertIn("Liana bench drive", self.drive("read", "--node", "3", "1008").stdout)
        done = self.drive("read", "--node", "3", "2345:6")
        self.assertEqual(done.returncode, 1)
        self.assertIn("0x06020000", done.stderr)

    def test_an_object_is_written_and_read_back(self):
        done = self.drive("write", "--node", "3", "6065", "1234", "--json")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(json.loads(done.stdout)["unsigned"], 1234)
        done = self.drive("write", "--node", "3", "6041", "1", "--bits", "16")
        self.assertEqual(done.returncode, 1)
        self.assertIn("0x06010002", done.stderr)

    def test_a_value_is_written_as_read_writes_it(self):
        for given, bits, kept in (("0x4D2", "32", 1234), ("0Xffffffff", "32", 0xFFFFFFFF), ("-1", "32", 0xFFFFFFFF)):
            done = self.drive("write", "--node", "3", "6065", given, "--bits", bits, "--json")
            self.assertEqual((done.returncode, json.loads(done.stdout)["unsigned"]), (0, kept), done.stderr)
        for given, bits, said in (
            ("0x", "32", ("VALUE", "0x", "0x0", "0xFFFFFFFF", "--bits 32")),
            ("0x100", "8", ("VALUE", "0x100", "0x0", "0xFF", "--bits 8")),
            ("0x-1", "32", ("VALUE", "0x-1")),
            ("0x1g", "16", ("VALUE", "0x1g", "0x0", "0xFFFF", "--bits 16")),
            ("1e3", "32", ("VALUE", "1e3", "-2147483648", "4294967295", "0x1F")),
        ):
            done = run("liana", "drive", "write", "--node", "3", "6065", given, "--bits", bits, "--can", "can9")
            self.assertEqual(done.returncode, 2, done.stderr)
            self.assert_names(done.stderr, *said)

    def test_a_write_of_another_size_than_the_object_s_is_told_where_the_size_stands(self):
        for bits in ("8", "16"):
            done = self.drive("write", "--node", "3", "6065", "100", "--bits", bits)
            self.assertEqual(done.returncode, 1, done.stdout)
            self.assert_names(done.stderr, "--bits", "liana drive read")
        self.assertIn("(32 bits)", self.drive("read", "--node", "3", "6065").stdout)

    def test_help_says_the_exit_codes_of_these_commands(self):
        for words in ((), ("scan",), ("jog",)):
            said = run("liana", "drive", *words, "--help").stdout
            self.assertIn("3 nobody answers", said)
            self.assertNotIn("inverse kinematics", said)

    def test_what_ends_the_bus_is_called_by_its_own_name(self):
        with Desk() as desk:
            self.assertEqual(run("liana", "drive", "read", "--node", "3", "6064", *desk.where()).returncode, 0)
            desk.children["liana-bus"].wait(timeout=60)
            self.assertIn("liana left after", desk.log("liana-bus"))

    def test_watch_reads_again_and_again(self):
        done = self.drive("watch", "--node", "3", "6064", "--seconds", "1", "--rate", "5", "--json")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(len(done.stdout.splitlines()), 5)

    def test_check_names_everything_that_a_boot_would_refuse_and_writes_nothing(self):
        bus = self.bus_of("{ type = 'maxon_epos4', nodes = { 2 } }")
        good = self.drive("check", "--node", "2", "--type", "maxon_epos4", "--json", bus=bus)
        self.assertEqual(good.returncode, 0, good.stdout + good.stderr)
        said = json.loads(good.stdout)
        self.assertEqual(said["refusals"], [])
        written = [each["object"][:4] for each in said["would_be_written"]]
        self.assertIn("6060", written)
        self.assertNotIn("6065", written, "the window follows from a robot, and there is none")
        bad = self.drive("check", "--node", "2", "--type", "nanotec_cl4e", "--json", bus=bus)
        self.assertEqual(bad.returncode, 1, bad.stdout)
        self.assertIn("0x1018:1", " ".join(json.loads(bad.stdout)["refusals"]))
        torque = self.drive("check", "--node", "2", "--type", "liana_cst", bus=bus)
        self.assert_names(torque.stdout, "0x3001:1", "damping", "0x06020000")
        self.assertNotIn("writing", torque.stdout)
        generic = self.drive("check", "--node", "2", "--json", bus=bus)
        self.assertIn("608F:1 (encoder counts)", json.loads(generic.stdout)["not_there"])

    def test_check_says_that_it_would_boot_and_with_try_carries_the_boot_out(self):
        read = json.loads(self.drive("check", "--node", "3", "--json").stdout)
        self.assertEqual((read["would_boot"], read["writes_tried"], read["mode_watched"]), (True, False, True))
        self.assertGreater(read["pdo_writes"], 0)
        done = self.drive("check", "--node", "3", "--try", "--json")
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        tried = json.loads(done.stdout)
        self.assertEqual((tried["would_boot"], tried["writes_tried"], tried["not_restored"]), (True, True, []))

    def test_a_drive_without_torque_is_refused_by_check_as_by_jog_until_its_type_says_so(self):
        folder = pathlib.Path(tempfile.mkdtemp(prefix="liana-drives-"))
        self.addCleanup(shutil.rmtree, folder)
        (folder / "drives").mkdir()
        text = "return { format = 1, kind = 'drive', name = '%s', source = 'a manual', %s dictionary = { absent = { '6077' } } }"
        for name, torque in (("weak", ""), ("plain", "torque = 'none',")):
            (folder / "drives" / f"{name}.lua").write_text(text % (name, torque))
        with unittest.mock.patch.dict(os.environ, LIANA_LUA_PATH=str(folder)):
            for name, code in (("weak", 1), ("plain", 0)):
                where = {"bus": self.bus_of("{ type = '%s', nodes = { 2 } }" % name)}
                checked = self.drive("check", "--node", "2", "--type", name, "--json", **where)
                self.assertEqual(checked.returncode, code, checked.stdout + checked.stderr)
                self.assertEqual(json.loads(checked.stdout)["would_boot"], code == 0)
                jogged = self.drive(
                    "jog", "--node", "2", "--type", name, "--by", "0.01", "--speed", "0.015", "--yes", **where
                )
                self.assertEqual(jogged.returncode, code, jogged.stdout + jogged.stderr)
                if code:
                    self.assert_names(checked.stdout, "6077", "1A00:3", "0x06020000")
                    self.assert_names(jogged.stderr, "6077", "0x06020000")

    def test_a_type_is_made_from_a_data_sheet_or_what_is_missing_is_named(self):
        folder = pathlib.Path(tempfile.mkdtemp(prefix="liana-drives-"))
        self.addCleanup(shutil.rmtree, folder)
        sheet = pathlib.Path(__file__).resolve().parents[2] / "hil" / "drive" / "liana_bench_drive.eds"
        out = folder / "made.lua"
        done = run("liana", "drive", "type", "--from-eds", sheet, "--out", out)
        self.assertEqual(done.returncode, 0, done.stderr)
        checked = run("liana-mission", "eval", "drive", out)
        self.assertEqual(checked.returncode, 0, checked.stderr)
        poor = folder / "poor.eds"
        poor.write_text("[1000]\nDataType=7\nDefaultValue=0x20191\n[1018sub1]\nDataType=7\nDefaultValue=1\n")
        done = run("liana", "drive", "type", "--from-eds", poor, "--out", folder / "no.lua", "--json")
        said = json.loads(done.stdout)
        self.assertEqual((done.returncode, said["ok"], said["table"]), (1, False, ""))
        self.assert_names(" ".join(said["missing"]), "6040", "401", "402")
        self.assertFalse((folder / "no.lua").exists())
        os.mkfifo(folder / "pipe.eds")
        for bad in (folder / "pipe.eds", folder, folder / "nobody.eds", "/dev/zero", out):
            done = run("liana", "drive", "type", "--from-eds", bad)
            self.assertEqual(done.returncode, 2, (bad, done.stderr))
            self.assert_names(done.stderr, pathlib.Path(bad).name)
        done = run("liana", "drive", "type", "--from-eds", sheet, "--mode", "pp")
        self.assertEqual(done.returncode, 2)
        self.assert_names(done.stderr, "pp", "csp", "cst")

    def test_a_drive_that_counts_over_several_turns_of_its_motor_is_as_good(self):
        folder = pathlib.Path(tempfile.mkdtemp(prefix="liana-drives-"))
        self.addCleanup(shutil.rmtree, folder)
        (folder / "drives").mkdir()
        (folder / "drives" / "five_turns.lua").write_text(
            "return { format = 1, kind = 'drive', name = 'five_turns', source = 'a manual', "
            f"dictionary = {{ values = {{ ['608F:1'] = 5 * {COUNTS_OF_MICRO}, ['608F:2'] = 5 }} }} }}\n"
        )
        with unittest.mock.patch.dict(os.environ, LIANA_LUA_PATH=str(folder)):
            done = self.drive("check", "--node", "2", bus=self.bus_of("{ type = 'five_turns', nodes = { 2 } }"))
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)

    def test_a_type_that_nothing_stops_is_said_by_check_and_jog(self):
        folder = pathlib.Path(tempfile.mkdtemp(prefix="liana-drives-"))
        self.addCleanup(shutil.rmtree, folder)
        file = folder / "loose.lua"
        file.write_text(
            "return { format = 1, kind = 'drive', name = 'loose', source = 'a manual', "
            "objects = { absent = { '1016:1', '1400:5', '6007' } } }\n"
        )
        checked = self.drive("check", "--node", "3", "--type", str(file))
        self.assert_names(checked.stdout, "type loose", "nothing")
        said = json.loads(self.drive("check", "--node", "3", "--type", str(file), "--json").stdout)
        self.assertFalse(said["stops_by_itself"])
        done = run("liana", "drive", "jog", "--node", "3", "--by", "0.1", "--type", file, "--bus", "embedded")
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assert_names(done.stderr, "loose", "nothing")
        self.assertNotIn("warning", self.drive("check", "--node", "3").stdout)

    def test_a_type_that_a_bus_table_cannot_find_is_to_go_below_lua_dir(self):
        done = run("liana", "drive", "scan", "--bus", self.bus_of("{ type = 'own_one', nodes = { 2 } }"))
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assert_names(done.stderr, "drives/own_one.lua", "--lua-dir")
        self.assertNotIn("or a file", done.stderr)

    def test_check_of_a_robot_names_what_every_drive_of_it_would_be_refused_for(self):
        good = self.drive("check", "--robot", "micro")
        self.assertEqual(good.returncode, 0, good.stdout + good.stderr)
        self.assert_names(good.stdout, "micro", "7 of 7 drives")
        bus = self.bus_of("{ type = 'maxon_epos4', bench = 'elmo_gold', nodes = { 2 } }")
        missing = {"drive": 5, "kind": "missing", "at_slot": 1}
        with Desk(bus, faults=[missing]) as desk:
            done = run("liana", "drive", "check", "--robot", "micro", "--json", *desk.where())
        self.assertEqual(done.returncode, 1, done.stderr)
        said = json.loads(done.stdout)
        self.assertEqual([each["ok"] for each in said["drives"]], [True, False, True, True, False, True, True])
        self.assertEqual([each["type"] for each in said["drives"][:3]], ["cia402_csp", "maxon_epos4", "cia402_csp"])
        self.assert_names(said["drives"][1]["refusals"][0], "0x1018:1", "vendor id", "251", "154")
        self.assert_names(said["drives"][4]["refusals"][0], "node 5", "can1", "no answer", "1 s")

    def test_check_compares_with_the_robot_table(self):
        with Desk("embedded_micro", "micro") as desk:
            table = json.loads((desk.directory / "robot.json").read_text())
            table["drives"]["counts_per_turn"] = 65536
            other = desk.directory / "other.json"
            other.write_text(json.dumps(table))
            done = run("liana", "drive", "check", "--robot", other, *desk.where())
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertEqual(done.stdout.count("608F"), 7, done.stdout)

    def test_bad_input_is_refused_before_anything_is_asked(self):
        for words, said in (
            (("read", "60G4", "--bus", "embedded"), ("60G4",)),
            (("read", "6064", "--node", "1"), ("--can",)),
            (("read", "6064", "--node", "1", "--bus", "embedded", "--can", "can0"), ("--bus", "--can")),
            (("write", "6065", "70000", "--bits", "16", "--bus", "embedded"), ("VALUE",)),
            (("write", "6040", "15", "--bits", "16", "--bus", "embedded"), ("6040", "torque")),
            (("scan", "--first", "0", "--bus", "embedded"), ("--first",)),
            (("check", "--type", "nobodys", "--bus", "embedded"), ("nobodys",)),
            (("check", "--robot", "nobodys", "--bus", "embedded"), ("nobodys",)),
            (("check", "--robot", "zhu2022", "--bus", "embedded_micro"), ("node 8",)),
            (("check", "--robot", "zhu2022", "--node", "3", "--bus", "embedded"), ("--node", "--robot")),
            (("watch", "6064", "--rate", "1000", "--bus", "embedded"), ("--rate",)),
            (("jog", "--by", "0.3", "--yes", "--bus", "embedded"), ("--by", "0.3 turns", "0.001", "0.25 turns")),
            (("jog", "--by", "-91", "--unit", "deg", "--yes", "--bus", "embedded"), ("--by", "-91", "0.36", "90 deg")),
            (
                ("jog", "--by", "0", "--yes", "--bus", "embedded"),
                ("--by", "0 turns", "0.001", "0.25 turns"),
            ),
            (
                ("jog", "--by", "0.1", "--speed", "0.3", "--yes", "--bus", "embedded"),
                ("--speed", "0.3 turns/s", "0.001", "0.25 turns/s"),
            ),
            (
                ("jog", "--by", "0.1", "--speed", "-0.1", "--yes", "--bus", "embedded"),
                ("--speed", "-0.1 turns/s", "0.001", "0.25 turns/s"),
            ),
            (("jog", "--by", "5", "--most", "101", "--yes", "--bus", "embedded"), ("--most", "101")),
            (("jog", "--by", "5", "--unit", "mm", "--yes", "--bus", "embedded"), ("--mm-per-turn",)),
            (("jog", "--by", "5", "--unit", "inch", "--yes", "--bus", "embedded"), ("--unit", "turns", "deg", "mm")),
            (("jog", "--by", "0.1", "--torque", "1001", "--yes", "--bus", "embedded"), ("--torque", "1001")),
            (
                ("jog", "--by", "0.1", "--torque", "5", "--yes", "--bus", "embedded"),
                ("--torque", "10", "1000 permille"),
            ),
            (("jog", "--by", "0.1", "--bus", "embedded", "--node", "1"), ("nothing moves unasked",)),
            (("write", "6065", "1", "--bits", "7", "--bus", "embedded"), ("--bits", "8", "16", "32")),
            (("write", "6065", "1", "--bits", "24", "--bus", "embedded"), ("--bits", "24", "8", "16", "32")),
        ):
            done = run("liana", "drive", *words)
            self.assertEqual(done.returncode, 2, (words, done.stderr))
            self.assert_names(done.stderr, *said)

    def test_a_drive_that_nobody_names_is_neither_moved_nor_told_anything(self):
        for words in (
            ("jog", "--by", "0.1", "--yes"),
            ("write", "6065", "5000"),
            ("read", "6064"),
            ("watch", "6064"),
            ("check",),
        ):
            done = run("liana", "drive", *words, "--bus", "embedded")
            self.assertEqual(done.returncode, 2, (words, done.stderr))
            self.assert_names(done.stderr, "--node", "not given", "1", "126")

    def test_a_way_that_is_too_small_is_not_told_to_raise_the_most(self):
        for words, raises in (
            (("--by", "0"), False),
            (("--by", "0.5"), True),
            (("--by", "101", "--most", "100"), False),
        ):
            done = run("liana", "drive", "jog", "--node", "1", "--yes", "--bus", "embedded", *words)
            self.assertEqual((done.returncode, "raise --most" in done.stderr), (2, raises), done.stderr)

    def test_a_type_that_follows_torques_is_not_jogged(self):
        words = ("--node", "1", "--by", "0.1", "--yes", "--type", "liana_cst", "--bus", "embedded")
        done = run("liana", "drive", "jog", *words)
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertIn("--type: liana_cst: follows torques", done.stderr)

    def test_a_bus_that_is_not_there_is_bad_input(self):
        nobody = "/nonexistent/bus.sock"
        for words, said in (
            (("--bus", "embedded"), "--bus-socket"),
            (("--bus", "embedded", "--bus-socket", nobody), nobody),
            (("--can", "nosuchcan"), "nosuchcan"),
        ):
            done = run("liana", "drive", "scan", *words)
            self.assertEqual(done.returncode, 2, (words, done.stderr))
            self.assertIn(said, done.stderr)

    def jog(self, *words, **options):
        """Node 3 of zhu2022: exit code, what it said as JSON, on standard error, and its statusword in the end."""
        with Desk("embedded", "zhu2022", **options) as desk:
            done = run("liana", "drive", "jog", "--node", "3", "--yes", "--json", *words, *desk.where())
            said = json.loads(done.stdout)
            return done.returncode, said, done.stderr, desk.statusword_at_the_end(2)

    def test_jog_moves_by_what_was_asked_and_disables(self):
        for words, turns in (
            (("--by", "0.02"), 0.02),
            (("--by", "9", "--unit", "deg"), 0.025),
            (("--by", "-1", "--unit", "mm", "--mm-per-turn", "94.25", "--speed", "5"), -0.01061),
        ):
            code, said, error, statusword = self.jog(*words)
            self.assertEqual((code, error), (0, ""), said)
            self.assertAlmostEqual(said["moved_turns"], turns, delta=0.0005)
            self.assertEqual(said["counts_per_turn"], 65536)
            samples = said["samples"]
            self.assertEqual(samples[0]["status"], "switch_on_disabled")
            self.assertIn("operation_enabled", [each["status"] for each in samples])
            places = [each["moved_turns"] for each in samples]
            self.assertTrue(all(min(0, turns) - 0.0005 <= place <= max(0, turns) + 0.0005 for place in places), places)
            self.assertTrue(all("current_permille" in each for each in samples[2:]), samples)
            self.assertLessEqual(said["most_torque_permille"], 375)
            self.assertEqual((said["is_off"], said["status"]), (True, "switch_on_disabled"))
            self.assertEqual(statusword & STATE, SWITCH_ON_DISABLED)

    def test_jog_ends_with_1_and_names_the_emergency_code_when_the_drive_fails(self):
        fault = {"drive": 3, "kind": "fault", "code": 0x7305, "at_slot": 500}
        code, said, error, statusword = self.jog("--by", "0.02", "--speed", "0.01", faults=[fault])
        self.assertEqual(code, 1, said)
        self.assertIn("emergency 0x7305, additional modules", error)
        self.assertEqual((said["emergency_code"], said["ok"], said["is_off"]), (0x7305, False, True))
        self.assertLess(said["moved_turns"], 0.015)
        self.assertEqual(statusword & STATE, FAULT)

    def test_jog_ends_with_1_when_the_drive_is_not_heard_any_more_and_says_that_nobody_knows(self):
        silence = {"drive": 3, "kind": "silent", "at_slot": 500}
        code, said, error, statusword = self.jog("--by", "0.02", "--speed", "0.01", faults=[silence])
        self.assertEqual((code, said["is_off"]), (1, False), said)
        self.assertIn("its reports stopped coming", error)
        self.assert_names(error, "not", "disabled")
        self.assertEqual(statusword & STATE, SWITCH_ON_DISABLED, "it has heard all the same")

    def test_jog_refuses_what_the_drive_could_not_stop(self):
        with Desk() as desk:
            words = ("--node", "3", "--yes", "--by", "0.1", "--speed", "0.2")
            done = run("liana", "drive", "jog", *words, *desk.where())
        self.assertEqual(done.returncode, 1)
        self.assert_names(done.stderr, "0x6085:0", "quick stop deceleration")
        self.assert_names(done.stderr, "--speed", "--by")
        self.assertNotIn("robot table", done.stderr)

    def test_jog_of_a_motor_without_encoder_counts_wants_to_be_told_them(self):
        bus = self.bus_of("{ type = 'maxon_epos4', nodes = { 7 } }")
        words = ("jog", "--node", "7", "--type", "maxon_epos4", "--by", "0.005", "--speed", "0.01", "--yes", "--json")
        done = self.drive(*words, bus=bus)
        self.assertEqual(done.returncode, 2, done.stdout)
        self.assertIn("--counts-per-turn: not given", done.stderr)
        done = self.drive(*words, "--counts-per-turn", "1048576", bus=bus)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertAlmostEqual(json.loads(done.stdout)["moved_counts"], 5243, delta=530)

    def signalled(self, number, awaited, *words):
        """A subcommand that is sent a signal when it has said `awaited`: exit code, what it said on standard error, and
        the statusword of drive 2 in the end.
        """
        with Desk("embedded", "zhu2022", "paced") as desk:
            call = [program("liana"), "drive", *words, "--node", "3", *map(str, desk.where())]
            with subprocess.Popen(call, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as child:
                line = child.stdout.readline()
                while line and awaited not in line:
                    line = child.stdout.readline()
                self.assertTrue(line, child.poll())
                child.send_signal(number)
                begun = time.monotonic()
                _, error = child.communicate(timeout=30)
            self.assertLess(time.monotonic() - begun, 5)
            return child.returncode, error, desk.statusword_at_the_end(2)

    def test_jog_that_is_interrupted_stops_and_disables(self):
        way = ("jog", "--yes", "--by", "0.1", "--speed", "0.01", "--torque", "1000")
        code, error, statusword = self.signalled(signal.SIGINT, "operation_enabled", *way)
        self.assertEqual(code, 130, error)
        self.assertIn("interrupted; it has moved", error)
        self.assertIn("disabled: switch_on_disabled", error)
        self.assertEqual(statusword & STATE, SWITCH_ON_DISABLED)

    def test_a_drive_whose_jog_is_killed_stops_by_itself(self):
        way = ("jog", "--yes", "--by", "0.1", "--speed", "0.01", "--torque", "1000")
        code, _, statusword = self.signalled(signal.SIGKILL, "operation_enabled", *way)
        self.assertEqual((code, statusword & STATE), (-signal.SIGKILL, SWITCH_ON_DISABLED))

    def test_watch_that_is_interrupted_ends_with_130(self):
        code, error, _ = self.signalled(signal.SIGINT, "bits", "watch", "6064")
        self.assertEqual((code, error), (130, "liana: interrupted; nothing more is asked or told\n"))

    def test_a_bus_whose_time_stands_still_is_said_and_left_by_ctrl_c(self):
        with Desk() as desk:
            bench = desk.children["liana-bench"]
            bench.send_signal(signal.SIGSTOP)
            call = [program("liana"), "drive", "scan", *map(str, desk.where())]
            with subprocess.Popen(call, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as child:
                self.assert_names(child.stderr.readline(), "liana", "bus", "3 s")
                child.send_signal(signal.SIGINT)
                _, error = child.communicate(timeout=30)
            bench.send_signal(signal.SIGCONT)
        self.assertEqual(child.returncode, 130, error)
        self.assertIn("interrupted", error)


if __name__ == "__main__":
    unittest.main()
