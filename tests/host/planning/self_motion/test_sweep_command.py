"""`liana sweep` as users call it: what it prints, its picture, and what it says about bad input."""
import json
import pathlib
import sys
import tempfile
import unittest
import xml.etree.ElementTree

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "apps" / "cli"))
from programs import liana, liana_json  # noqa: E402

SVG = "{http://www.w3.org/2000/svg}"


class Sweep(unittest.TestCase):
    # req:B10 req:B13
    def test_the_large_arm_goes_around_with_its_tip_still(self):
        answer = liana_json("sweep", "--robot", "macro")
        self.assertTrue(answer["closed"])
        self.assertAlmostEqual(answer["arm_angle_deg"], 360.0, delta=1.0)
        self.assertLess(answer["tip_drift_m"], 1e-9)
        self.assertGreater(len(answer["way"]), 300)
        for row in answer["way"]:
            self.assertTrue(all(abs(part) <= 0.02001 for part in row["deflection_m_per_N"]))
            self.assertEqual(len(row["theta_deg"]), 7)

    def test_the_small_arm_is_swept_from_any_pose(self):
        answer = liana_json("sweep", "--robot", "micro", "--from-deg", "install")
        self.assertTrue(answer["closed"])
        self.assertLess(answer["tip_drift_m"], 1e-9)

    def test_the_same_call_prints_the_same_bytes(self):
        self.assertEqual(liana("sweep", "--json"), liana("sweep", "--json"))

    def test_the_picture_marks_stiffest_and_softest(self):
        with tempfile.TemporaryDirectory() as directory:
            file = pathlib.Path(directory) / "picture.svg"
            self.assertEqual(liana("sweep", "--svg", file)[0], 0)
            words = [element.text for element in xml.etree.ElementTree.parse(file).getroot().iter(SVG + "text")]
            self.assertNotIn("nan", file.read_text())
        self.assertTrue(any("stiffest" in text for text in words) and any("softest" in text for text in words), words)

    def test_a_singular_start_is_a_failure_with_a_reason(self):
        code, _, error = liana("sweep", "--from-deg=zero")
        self.assertEqual(code, 1)
        self.assertIn("singular", error)

    def test_bad_input_is_refused_by_name(self):
        robot = json.loads(liana("robot", "export", "macro")[1])
        for joint in robot["joints"]:
            del joint["stiffness_Nm_per_rad"]
        with tempfile.TemporaryDirectory() as directory:
            soft = pathlib.Path(directory) / "soft.json"
            soft.write_text(json.dumps(robot))
            for words, said in (
                (["--robot", "zhu2022"], "serial arm"),
                (["--robot", str(soft)], "stiffness_Nm_per_rad"),
                (["--from-deg=1,2,3"], "--from-deg"),
                (["--from-deg=nowhere"], "--from-deg"),
                (["--svg=/nowhere/picture.svg"], "--svg"),
            ):
                code, _, error = liana("sweep", *words)
                self.assertEqual(code, 2, words)
                self.assertIn(said, error)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
