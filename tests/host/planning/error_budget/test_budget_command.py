"""`liana budget` as users call it: what it prints, its picture, and what it says about bad input."""
import pathlib
import sys
import tempfile
import unittest
import xml.etree.ElementTree

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "apps" / "cli"))
from programs import liana, liana_json  # noqa: E402

OWN = """return { format = 1, kind = "budget", name = "own",
  open_loop = { errors = { { name = "arm", position_m = 0.003 } }, terms = { { name = "it", positions = { "arm" } } } },
  closed_loop = { errors = { { name = "eye", position_m = 0.001 } },
                  terms = { { name = "it", positions = { "eye" } } } } }
"""
SVG = "{http://www.w3.org/2000/svg}"


class Budget(unittest.TestCase):
    # req:B8 req:B9
    def test_the_chain_that_is_shipped_is_that_of_the_source(self):
        answer = liana_json("budget")
        self.assertAlmostEqual(answer["open_loop_m"], 0.14198, delta=5e-6)
        self.assertLess(answer["closed_loop_m"], 0.020)
        self.assertEqual(len(answer["contributions"]["open_loop"]), 3)
        self.assertAlmostEqual(answer["monte_carlo"]["open_loop"]["p95_m"], 0.144, delta=0.002)

    def test_any_chain_can_be_given_as_a_file(self):
        with tempfile.TemporaryDirectory() as directory:
            file = pathlib.Path(directory) / "own.lua"
            file.write_text(OWN)
            answer = liana_json("budget", str(file))
        self.assertEqual((answer["budget"], answer["open_loop_m"], answer["closed_loop_m"]), ("own", 0.003, 0.001))

    def test_the_same_call_prints_the_same_bytes(self):
        self.assertEqual(liana("budget", "--json"), liana("budget", "--json"))

    def test_the_picture_names_every_term(self):
        with tempfile.TemporaryDirectory() as directory:
            file = pathlib.Path(directory) / "picture.svg"
            code, text, error = liana("budget", "--svg", file)
            self.assertEqual(code, 0, error)
            words = [element.text for element in xml.etree.ElementTree.parse(file).getroot().iter(SVG + "text")]
        for name in ("macro, at the end of the micro", "both angles over the payload", "camera and micro"):
            self.assertIn(name, words)
            self.assertIn(name, text)

    def test_bad_input_is_refused_by_name(self):
        for words, said in (
            (["nowhere"], "payload_install"),
            (["--draws=10"], "100"),
            (["--draws=many"], "--draws"),
            (["--svg=/nowhere/picture.svg"], "--svg"),
            (["/dev/null"], "/dev/null"),
        ):
            code, _, error = liana("budget", *words)
            self.assertEqual(code, 2, words)
            self.assertIn(said, error)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
