"""`liana reach` as users call it: what it prints, its pictures, and what it says about bad input."""
import json
import pathlib
import sys
import tempfile
import unittest
import xml.etree.ElementTree

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "apps" / "cli"))
from programs import ROOT, interrupt, liana, liana_json, start_liana  # noqa: E402
from message import Messages  # noqa: E402

PREPARE = "-8.5,0,-12,0,8,-2,13,0,12,-2"
PANEL_EDGE = "-6.14,-15,-3.29,-8.72,7.2,15,5.55,15,1,-2.8"
FEW = "--samples=2000"
SVG = "{http://www.w3.org/2000/svg}"


def picture(*options):
    """The picture of a call as a parsed tree: fails when it is not well-formed XML."""
    with tempfile.TemporaryDirectory() as directory:
        file = pathlib.Path(directory) / "picture.svg"
        code, _, error = liana("reach", *options, "--svg", file)
        assert code == 0, error
        assert "nan" not in file.read_text() and 'inf"' not in file.read_text()
        return xml.etree.ElementTree.parse(file).getroot()


def texts(root):
    return [element.text for element in root.iter(SVG + "text") if element.text]


class Region(unittest.TestCase):
    def test_the_answer_holds_extent_boundary_profile_and_what_binds(self):
        answer = liana_json("reach", FEW)
        self.assertAlmostEqual(answer["extent_m"]["x"][1], 4.0, delta=1e-9)
        self.assertEqual((answer["node"], answer["dimension"], answer["held_deg"]), (5, 3, {}))
        self.assertAlmostEqual(sum(shell["share"] for shell in answer["radial_profile"]), 1.0, delta=1e-9)
        self.assertEqual(len(answer["outer_binding"]["theta_share"]), 10)
        for found in filter(lambda found: found["outer"], answer["boundary"]):
            self.assertGreaterEqual(found["outer"]["distance_m"], found["inner"]["distance_m"])
            self.assertTrue(all(abs(angle) <= 20.0 + 1e-9 for angle in found["outer"]["theta_deg"]))

    def test_held_angles_are_where_they_were_put_or_where_the_pose_has_them(self):
        answer = liana_json("reach", FEW, "--hold=7=0.5,9", f"--from-deg={PREPARE}")
        self.assertAlmostEqual(answer["held_deg"]["7"], 0.5, delta=1e-12)
        self.assertAlmostEqual(answer["held_deg"]["9"], 12.0, delta=1e-12)

    def test_the_same_call_prints_the_same_bytes(self):
        self.assertEqual(liana("reach", FEW, "--json"), liana("reach", FEW, "--json"))


class SerialArm(Messages, unittest.TestCase):
    def test_the_answer_has_the_fields_of_a_cable_arm(self):
        answer = liana_json("reach", "--robot=micro", FEW)
        self.assertEqual(set(answer), set(liana_json("reach", FEW)))
        self.assertEqual((answer["robot"], answer["node"], answer["dimension"]), ("micro", 7, 3))
        self.assertEqual((answer["origin_m"], answer["held_deg"]), ([0, 0, 0], {}))
        self.assertAlmostEqual(answer["farthest_m"], 4.93, delta=0.005)
        self.assertEqual(answer["outer_binding"], {"theta_share": [0] * 7, "no_limit_share": 1})

    def test_the_places_it_names_are_those_that_pose_gives_for_its_angles(self):
        answer = liana_json("reach", "--robot=macro_micro", FEW, "--node=5")
        for found in answer["boundary"][::40]:
            angles = found["outer"]["theta_deg"]
            self.assertTrue(all(abs(angle) <= 270 for angle in angles))
            pose = liana_json("pose", "--robot=macro_micro", f"--theta-deg={','.join(map(str, angles))}")
            for there, here in zip(pose["joint_points_m"][5], found["outer"]["point_m"]):
                self.assertAlmostEqual(there, here, delta=1e-9)

    def test_ranges_of_its_joints_are_what_binds(self):
        robot = json.loads(liana("robot", "export", "micro")[1])
        for joint in robot["joints"][2:6]:
            joint["low_deg"], joint["high_deg"] = 30, 80  # booms that never stretch
        robot["named_poses_deg"] = {"zero": [0, 0, 40, 40, 40, 40, 0]}
        robot.pop("start_pose", None)
        with tempfile.TemporaryDirectory() as directory:
            file = pathlib.Path(directory) / "robot.json"
            file.write_text(json.dumps(robot))
            answer = liana_json("reach", "--robot", file, FEW)
        self.assertLess(answer["farthest_m"], 4.8)
        self.assertGreater(max(answer["outer_binding"]["theta_share"]), 0.9)
        self.assertEqual([answer["outer_binding"]["theta_share"][i] for i in (0, 1, 6)], [0, 0, 0])

    def test_the_same_call_prints_the_same_bytes(self):
        call = ("reach", "--robot=micro", FEW, "--json")
        self.assertEqual(liana(*call), liana(*call))

    def test_a_summary_speaks_of_joints_and_points(self):
        code, out, _ = liana("reach", "--robot=macro", FEW)
        self.assertEqual(code, 0)
        self.assert_names(out, "point 7", "none")
        self.assert_names(out, "links", "10.764 m")

    def test_its_region_is_drawn_with_arm_and_scene(self):
        words = texts(picture(FEW, "--robot=micro", "--scene=target_ahead", "--from-deg=0,60,-30,100,-40,60,0"))
        for needed in [("tip", "micro"), ("top view", "+z"), ("arm", "points", "base")]:
            self.assert_names("\n".join(words), *needed)
        self.assert_names("\n".join(texts(picture(FEW, "--robot=macro", "--node=4"))), "point 4", "macro")


class Path(unittest.TestCase):
    def test_the_worst_places_are_those_of_the_points(self):
        answer = liana_json("reach", f"--from-deg={PREPARE}", f"--to-deg={PANEL_EDGE}")
        self.assertEqual(
            answer["worst_conditioned"], min(answer["points"], key=lambda point: point["least_singular_value"])
        )
        self.assertEqual(answer["nearest_limit"], min(answer["points"], key=lambda point: point["limit_margin_deg"]))
        self.assertAlmostEqual(answer["points"][0]["least_singular_value"], 4.10, delta=0.005)
        self.assertEqual(answer["nearest_limit"]["nearest_theta"], 2)

    def test_a_file_of_waypoints_is_the_same_as_its_ends_on_the_command_line(self):
        rows = [[float(x) for x in text.split(",")] for text in (PREPARE, PANEL_EDGE)]
        with tempfile.TemporaryDirectory() as directory:
            file = pathlib.Path(directory) / "plan.json"
            file.write_text(json.dumps({"outcome": "solved", "waypoints_deg": rows}))
            self.assertEqual(
                liana_json("reach", "--path", file),
                liana_json("reach", f"--from-deg={PREPARE}", f"--to-deg={PANEL_EDGE}"),
            )

    def test_a_condition_without_bound_is_null(self):
        zero = ",".join(["0"] * 10)
        self.assertIsNone(liana_json("reach", f"--from-deg={zero}", f"--to-deg={PREPARE}")["points"][0]["condition"])


class Pictures(Messages, unittest.TestCase):
    def test_a_region_shows_three_views_with_axes_and_a_legend(self):
        words = texts(picture(FEW, "--scene=panel_slit", "--hold=7,9"))
        for needed in [
            ("tip", "zhu2022"),
            ("theta 7 = 0", "theta 9 = 0"),
            ("top view", "+z"),
            ("side view", "-y"),
            ("front view", "+x"),
            ("x (m)",),
            ("y (m)",),
            ("z (m)",),
            ("obstacle",),
            ("press rod", "ring"),
        ]:
            self.assert_names("\n".join(words), *needed)

    def test_the_scene_and_the_arm_are_to_scale(self):
        root = picture(FEW, "--scene=panel_slit")
        ticks = {
            element.text: float(element.get("x"))
            for element in root.iter(SVG + "text")
            if element.get("text-anchor") == "middle" and element.text in ("1", "2")
        }
        self.assertEqual(len(ticks), 2)
        pixels_per_m = ticks["2"] - ticks["1"]
        spheres = [float(element.get("r")) for element in root.iter(SVG + "circle") if element.get("opacity") == "0.55"]
        self.assertEqual(sum(abs(radius - 0.25 * pixels_per_m) < 0.15 for radius in spheres), 3)  # one a view
        arms = [
            float(element.get("stroke-width"))
            for element in root.iter(SVG + "polyline")
            if element.get("stroke") == "#f28e2b"
        ]
        self.assertEqual(len(arms), 3)
        self.assertTrue(all(abs(width - 0.06 * pixels_per_m) < 0.15 for width in arms))

    def test_every_use_gives_a_picture(self):
        for options in [
            ("--node=1",),
            ("--node=3", "--hold=1,2"),
            ("--hold=1,2,3,4,5,6,7,8,9",),
            ("--hold=2,4,6,8,10",),
            ("--hold=1=20,2=-20",),
        ]:
            self.assertIn("In figures", texts(picture(FEW, *options)))
        for options in [(), ("--hold=7,9",), ("--hold=1,2,3,4,5",), ("--hold=1,2,3,4,5,6,7,8,9",)]:
            words = texts(picture(f"--from-deg={PREPARE}", f"--to-deg={PANEL_EDGE}", *options))
            self.assert_names("\n".join(words), "margin", "deg")
        self.assertIn("condition number", texts(picture(f"--from-deg={PREPARE}", f"--to-deg={PREPARE}")))

    def test_the_pictures_of_the_documentation_are_well_formed_and_small(self):
        files = sorted((ROOT / "docs/pictures").glob("*.svg"))
        self.assertGreaterEqual(len(files), 2)
        for file in files:
            xml.etree.ElementTree.parse(file)
            self.assertLess(file.stat().st_size, 100_000, file)


class Interrupt(unittest.TestCase):
    def test_ctrl_c_ends_with_130_and_one_message(self):
        running = start_liana("reach", "--samples=1000000")
        interrupt(running)
        self.assertEqual((*running.communicate(), running.returncode), ("", "liana: interrupted\n", 130))


class BadInput(Messages, unittest.TestCase):
    def expect_refusal(self, options, *named):
        code, out, error = liana("reach", *options)
        self.assertEqual((code, out), (2, ""), (options, error))
        self.assert_names(error, *named)
        self.assertEqual(error.count("\n"), 1, error)

    def test_every_wrong_option_ends_with_2_and_one_message(self):
        ends = (f"--from-deg={PREPARE}", f"--to-deg={PANEL_EDGE}")
        for options, *named in [
            (["--node=6"], "--node", "6", "1", "5"),
            (["--node=0"], "--node", "0", "whole", "1", "5"),
            (["--node=x"], "--node"),
            (["--samples=999"], "--samples", "999", "1000", "1000000"),
            (["--samples=1000001"], "--samples", "1000001", "1000", "1000000"),
            (["--samples=nan"], "--samples"),
            (["--seed=-1"], "--seed", "-1"),
            ([f"--seed={2**64}"], "--seed", "0", "9007199254740991"),
            (["--hold=11"], "--hold"),
            (["--hold=7=21"], "--hold", "21", "theta 7"),
            (["--hold=7=nan"], "nan"),
            (["--hold=1,2", "--node=1"], "--hold", "theta 1 to 2"),
            (["--hold=1,2,3,4,5,6,7,8,9,10"], "--hold", "theta 1 to 10"),
            (["--from-deg=0"], "10 numbers"),
            (["--robot=nobody"], "nobody"),
            (["--scene=nowhere"], "nowhere"),
            ([FEW, "--svg=/no/such/directory/x.svg"], "--svg"),
            ([f"--to-deg={PREPARE}"], "--from-deg"),
            ([*ends, "--hold=7=1"], "--hold", "without values"),
            ([*ends, "--node=3"], "--node"),
            ([*ends, "--scene=panel_slit"], "--scene"),
            ([*ends, "--hold=1,2,3,4,5,6,7,8,9,10"], "--hold", "theta 1 to 10"),
            (["--path=/no/such/file"], "/no/such/file"),
            (["--path=x.json", f"--to-deg={PREPARE}"], "--to-deg"),
            (["--path=x.json", f"--from-deg={PREPARE}"], "--from-deg"),
        ]:
            self.expect_refusal(options, *named)

    def test_what_a_serial_arm_does_not_have_is_refused_with_option_value_and_what_to_do(self):
        only = ("robot micro", "serial")
        zero = "0,0,0,0,0,0,0"
        for options, *named in [
            (["--hold=7"], "--hold", "7", *only),
            (["--path=x.json"], "--path", "x.json", *only, "liana sweep"),
            ([f"--from-deg={zero}", f"--to-deg={zero}"], "--to-deg", zero, *only, "liana sweep"),
            (["--node=8"], "--node", "8", "whole", "1", "7"),
            (["--node=0"], "--node", "0", "1", "7"),
            (["--node=1"], "--node", "1", "no joint"),
            (["--from-deg=0"], "7 numbers"),
            ([f"--from-deg=271,{zero[2:]}"], "-270", "270"),
            (["--samples=999"], "--samples", "999", "1000", "1000000"),
            (["--scene=nowhere"], "nowhere"),
            ([FEW, "--svg=/no/such/directory/x.svg"], "--svg"),
        ]:
            self.expect_refusal(["--robot=micro", *options], *named)

    def test_every_wrong_file_of_waypoints_ends_with_2_and_one_message(self):
        with tempfile.TemporaryDirectory() as directory:
            file = pathlib.Path(directory) / "path.json"
            for content, *named in [
                ("", "readable file"),
                ("[]", "waypoints_deg"),
                ("{}", "waypoints_deg"),
                ('{"waypoints_deg": []}', "1", "2000"),
                ('{"waypoints_deg": [1]}', "row 1"),
                ('{"waypoints_deg": [[1, "2"]]}', "row 1"),
                ('{"waypoints_deg": [[1, 2]]}', "10 numbers"),
                ('{"waypoints_deg": [[]]}', "10 numbers"),
                (f'{{"waypoints_deg": [[{PREPARE}], [21,0,0,0,0,0,0,0,0,0]]}}', "row 2"),
                (json.dumps({"waypoints_deg": [[0.0] * 10] * 2001}), "1", "2000"),
            ]:
                file.write_text(content)
                self.expect_refusal(["--path", file], *named)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
