"""That quoted_sentences.py finds what it has to find, and that the facts of a message are compared as said."""

import pathlib
import sys
import tempfile
import unittest

import quoted_sentences

sys.path.append(str(quoted_sentences.ROOT / "tests"))

from message import has_word, sentences, unnamed  # noqa: E402

PRODUCT = 'throw Refused("cables.EA_N: %g: the shortest cable would tear at once");\n'
QUOTE = "1e6: the shortest cable would tear"


def found(test, name="tests/host/a_test.cpp", product=PRODUCT):
    with tempfile.TemporaryDirectory() as folder:
        for file, text in (("host/a.cpp", product), (name, test)):
            path = pathlib.Path(folder, file)
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text)
        return quoted_sentences.quotes(pathlib.Path(folder))


def count(*given, **named):
    return sum(map(len, found(*given, **named).values()))


class QuotedSentences(unittest.TestCase):
    def test_a_quote_is_found_however_it_is_compared_and_with_its_line(self):
        for test in (
            f'EXPECT_EQ(said, "{QUOTE}");',
            f'EXPECT_NE(said.find("{QUOTE}"), npos);',
            f'const Row rows[] = {{{{1, "{QUOTE}"}}}};',
            'EXPECT_EQ(said, "1e6: the shortest "\n "cable would tear");',
        ):
            self.assertEqual(list(found("\n" + test)), ["tests/host/a_test.cpp"], test)
            self.assertEqual(found("\n" + test)["tests/host/a_test.cpp"][0][0], 2)
        for test in (
            f'self.assertIn("{QUOTE}", error)',
            f'self.assertEqual(error, f"{{name}}: {QUOTE}")',
            f'for words, said in [(["x"], "{QUOTE}")]:\n    pass',
        ):
            self.assertEqual(count(test, "tests/system/a_test.py"), 1, test)
        self.assertEqual(count(f"assert_equal(said, '{QUOTE}')", "tests/lua/a.lua"), 1)

    def test_what_is_for_the_reader_of_a_failure_is_no_quote(self):
        for test in (
            f'EXPECT_TRUE(is_well) << "{QUOTE}";',
            f'SCOPED_TRACE("{QUOTE}");',
            f"// {QUOTE}\n",
        ):
            self.assertEqual(count(test), 0, test)
        for test in (f'"""{QUOTE}"""', f'self.assertTrue(well, "{QUOTE}")', f'raise ValueError("{QUOTE}")'):
            self.assertEqual(count(test, "tests/system/a_test.py"), 0, test)

    def test_facts_short_texts_and_texts_that_the_product_does_not_say_are_no_quotes(self):
        for text in (
            "shortest cable",
            "cables.EA_N",
            "a note of the test on one of its rows",
            "local x = the shortest cable",
        ):
            self.assertEqual(count(f'EXPECT_EQ(said, "{text}");'), 0, text)

    def test_the_word_allowed_is_of_every_message(self):
        self.assertEqual(count('EXPECT_EQ(said, "speed: 7: allowed 0 to 5 m");'), 1)

    def test_a_folder_that_tests_no_message_is_passed_over(self):
        self.assertEqual(count(f'EXPECT_EQ(said, "{QUOTE}");', "tests/numbers/a.cpp"), 0)

    def test_more_quotes_than_are_known_and_fewer_are_problems(self):
        rows = {"tests/a_test.cpp": [(3, QUOTE), (9, QUOTE)]}
        self.assertEqual(list(quoted_sentences.problems(rows, {"tests/a_test.cpp": (2, "why")})), [])
        (more,) = quoted_sentences.problems(rows, {"tests/a_test.cpp": (1, "why")})
        self.assertTrue(has_word(more, "tests/a_test.cpp"), more)
        self.assertTrue(QUOTE in more and "9" in more, more)
        (fewer,) = quoted_sentences.problems({}, {"tests/a_test.cpp": (1, "why")})
        self.assertTrue(has_word(fewer, "KNOWN"), fewer)


class Facts(unittest.TestCase):
    def test_a_word_is_whole(self):
        for text, word in (
            ("hold[9]: 45: allowed -20 to 20 deg", "hold[9]"),
            ("hold[9]: 45: allowed -20 to 20 deg", "-20"),
            ("hold[9]: 45: allowed -20 to 20 deg", "20"),
            ("Drive 4 is off by +3.3 mm.", "drive 4"),
            ("Drive 4 is off by +3.3 mm.", "3.3 mm"),
            ("--from: 'nan'", "--from"),
            ("/tmp/x/given.lua:3: steer.node: 9", "given.lua:3"),
        ):
            self.assertTrue(has_word(text, word), (text, word))
        for text, word in (
            ("0.2 12 -2 joint_2 2.5", "2"),
            ("steer.node steer[1] steering", "steer"),
            ("--from-deg", "--from"),
            ("liana-bench", "bench"),
        ):
            self.assertFalse(has_word(text, word), (text, word))

    def test_one_line_has_all_facts_in_two_sentences_at_most(self):
        text = "a heading\nspeed_m_s is 7 m/s, maximum 5 m/s. Ask for less.\n"
        self.assertEqual(unnamed(text, ["speed_m_s", "7 m/s", "5 m/s"]), "")
        self.assertIn("'heading'", unnamed(text, ["speed_m_s", "heading"]))
        self.assertIn("two sentences", unnamed("One 5. Two. Three.", ["5"]))
        self.assertEqual(sentences("Drive 1.5 of 2. Check it, e.g. by hand."), 2)


if __name__ == "__main__":
    unittest.main()
