// Tests compare the facts of a message, not its sentence: prose can be mended, and a wrong error is still found.
// Where there is a code, compare the code and the field; `names` is for what is text alone.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <string>
#include <string_view>
#include <vector>

namespace liana {

// What a message has to name: field, option, file, measured value, limit; each without prose, in any order.
using Facts = std::vector<std::string>;

namespace message {

inline bool in_word(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; }

inline bool same_letter(char a, char b) {
  return std::tolower(static_cast<unsigned char>(a)) == std::tolower(static_cast<unsigned char>(b));
}

// '\0' outside of the text.
inline char letter(std::string_view text, std::size_t at) { return at < text.size() ? text[at] : '\0'; }

// "2" is no word of 0.2, 12, -2 or joint_2, and `steer` none of steer.node or steer[1].
inline bool is_whole(std::string_view text, std::size_t at, std::size_t size) {
  const char first = text[at], last = text[at + size - 1];
  const char before = at > 0 ? text[at - 1] : '\0', far_before = at > 1 ? text[at - 2] : '\0';
  const char after = letter(text, at + size), far_after = letter(text, at + size + 1);
  const bool digit = std::isdigit(static_cast<unsigned char>(first)) != 0;
  if (in_word(first) && in_word(before)) return false;
  if (in_word(first) && (before == '.' || before == '-') && in_word(far_before)) return false;
  if (digit && before == '-') return false;
  if (first == '-' && (before == '-' || in_word(before))) return false;
  if (!in_word(last)) return true;
  return !in_word(after) && after != '[' && !((after == '.' || after == '-') && in_word(far_after));
}

inline bool has_word(std::string_view text, std::string_view word) {
  for (auto at = text.begin(); at != text.end(); ++at) {
    at = std::search(at, text.end(), word.begin(), word.end(), same_letter);
    if (at == text.end()) return false;
    if (is_whole(text, static_cast<std::size_t>(at - text.begin()), word.size())) return true;
  }
  return false;
}

// Full stops, question and exclamation marks that a capital letter or the end follows; at least one.
inline int sentences(std::string_view line) {
  while (!line.empty() && (line.back() == ' ' || line.back() == '.')) line.remove_suffix(1);
  int count = 1;
  for (std::size_t i = 0; i + 2 < line.size(); ++i) {
    const bool ends = line[i] == '.' || line[i] == '!' || line[i] == '?';
    if (ends && line[i + 1] == ' ' && std::isupper(static_cast<unsigned char>(line[i + 2])) != 0) ++count;
  }
  return count;
}

}  // namespace message

// Whether one line of `text` names every fact as a whole word (letters of either case) in at most two sentences.
inline testing::AssertionResult names(std::string_view text, const Facts& facts) {
  if (facts.empty()) return testing::AssertionFailure() << "no facts to look for";
  std::string missing = "no line";
  std::size_t least = facts.size() + 1;
  for (std::string_view rest = text; !rest.empty();) {
    const std::size_t end = std::min(rest.find('\n'), rest.size());
    const std::string_view line = rest.substr(0, end);
    rest.remove_prefix(std::min(end + 1, rest.size()));
    Facts absent;
    for (const std::string& fact : facts)
      if (fact.empty() || !message::has_word(line, fact)) absent.push_back(fact);
    if (absent.empty() && message::sentences(line) <= 2) return testing::AssertionSuccess();
    if (absent.size() >= least) continue;
    least = absent.size();
    missing = absent.empty() ? "more than two sentences" : "missing:";
    for (const std::string& fact : absent) missing += " '" + fact + "'";
  }
  return testing::AssertionFailure() << missing << "; in: " << text;
}

}  // namespace liana
