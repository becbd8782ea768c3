"""`liana drive`: one motor on a desk, with a bus and the bench's drives and nothing else."""
import json
import pathlib
import shutil
import tempfile
import unittest

from support import SystemTest
from liana.system import System, run


class Desk(System):
    """Bus and bench alone: the command is the only master."""

    def __init__(self, bus="embedded_micro"):
        super().__init__(bus=bus, robot="micro", scene="none")

    def start_programs(self):
        self.start_bus()
        self.start("liana-bench", *self.tables(), "--bus-socket", self.bus_socket, "--no-spread")


class DriveCommand(SystemTest):
    def drive(self, *words, bus="embedded_micro"):
        """One command, on a bus of its own: the bus ends with its master."""
        with Desk(bus) as desk:
            where = ("--bus", desk.directory / "buses.json", "--bus-socket", desk.bus_socket, "--time", "fast")
            return run("liana", "drive", *words, *where)

    def bus_of(self, drives):
        folder = pathlib.Path(tempfile.mkdtemp(prefix="liana-drives-"))
        self.addCleanup(shutil.rmtree, folder)
        file = folder / "own.lua"
        file.write_text(f"local t = require 'buses.embedded_micro'\nt.drives = {{ {drives} }}\nreturn t\n")
        return str(file)

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
        self.assertTrue(any(each["object"].startswith("6065") for each in said["would_be_written"]), said)
        bad = self.drive("check", "--node", "2", "--type", "nanotec_cl4e", "--json", bus=bus)
        self.assertEqual(bad.returncode, 1, bad.stdout)
        self.assertIn("0x1018:1", " ".join(json.loads(bad.stdout)["refusals"]))
        generic = self.drive("check", "--node", "2", "--json", bus=bus)
        self.assertIn("608F:1 (encoder counts)", json.loads(generic.stdout)["not_there"])

    def test_bad_input_is_refused_before_anything_is_asked(self):
        for words, said in (
            (("read", "60G4", "--bus", "embedded"), "60G4"),
            (("read", "6064"), "--can"),
            (("read", "6064", "--bus", "embedded", "--can", "can0"), "one of them"),
            (("write", "6065", "70000", "--bits", "16", "--bus", "embedded"), "VALUE"),
            (("write", "6040", "15", "--bits", "16", "--bus", "embedded"), "switches torque"),
            (("scan", "--first", "0", "--bus", "embedded"), "--first"),
            (("check", "--type", "nobodys", "--bus", "embedded"), "nobodys"),
            (("watch", "6064", "--rate", "1000", "--bus", "embedded"), "--rate"),
        ):
            done = run("liana", "drive", *words)
            self.assertEqual(done.returncode, 2, (words, done.stderr))
            self.assertIn(said, done.stderr)


if __name__ == "__main__":
    unittest.main()
