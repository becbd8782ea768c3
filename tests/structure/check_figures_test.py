"""That figures expire when what they measure has changed, and by no other commit."""

import pathlib
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "docs"))
import check_figures


class Figures(unittest.TestCase):
    def test_figures_of_the_newest_commit_have_not_expired(self):
        head = check_figures.git("rev-parse", "--short=12", "HEAD")
        self.assertEqual(check_figures.changes_since(f"commit {head}", ["firmware_like"]), 0)

    def test_the_oldest_of_several_commits_counts(self):
        newest = check_figures.git("rev-list", "-n", "1", "HEAD", "--", "host")
        before = check_figures.git("rev-parse", f"{newest}^")
        text = f"commits {newest[:12]} and {(before or newest)[:12]}"
        self.assertEqual(check_figures.changes_since(text, ["host"]), 1 if before else 0)

    def test_a_commit_that_the_history_does_not_have_is_named_as_such(self):
        self.assertIsNone(check_figures.changes_since("commit 0123456789ab", ["host"]))

    def test_every_section_with_sources_of_its_own_measures_folders_that_exist(self):
        for name, paths in check_figures.SOURCES.items():
            for path in paths:
                self.assertTrue((check_figures.ROOT / path).is_dir(), f"{name}: {path}")


if __name__ == "__main__":
    unittest.main()
