"""Comparing the facts of a message instead of its sentence, so that prose can be mended; as message.hpp does in C++."""

import re


def has_word(text, word):
    """Whether `word` stands whole in `text`: 2 is no word of 0.2, 12, -2 or joint_2, `steer` none of steer.node."""
    before = r"(?<!\w)(?<!\w[.-])" if re.match(r"\w", word) else r"(?<![\w-])" if word.startswith("-") else ""
    before += r"(?<!-)" if re.match(r"\d", word) else ""
    after = r"(?!\w|\[|[.-]\w)" if re.search(r"\w$", word) else ""
    return re.search(before + re.escape(word) + after, text, re.IGNORECASE) is not None


def sentences(line):
    return 1 + len(re.findall(r"[.!?] (?=[A-Z])", line.rstrip(" .")))


def unnamed(text, facts):
    """Empty if one line of `text` names every fact in at most two sentences; otherwise what is wrong with the best."""
    found = []
    for line in text.splitlines():
        absent = [fact for fact in facts if not fact or not has_word(line, fact)]
        if not absent and sentences(line) <= 2:
            return ""
        found.append((len(absent), " ".join(map(repr, absent)) or "more than two sentences"))
    return f"missing: {min(found)[1] if found else 'all'}; in: {text}"


class Messages:
    """For test cases: self.assert_names(error, "--from", "nan", "1e+09")."""

    def assert_names(self, text, *facts):
        facts = [str(fact) for fact in facts]
        self.assertTrue(facts, "no facts")
        problem = unnamed(text, facts)
        self.assertFalse(problem, problem)
