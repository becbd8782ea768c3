#include "host/base/options/nearest.hpp"

#include <algorithm>
#include <array>

#include "host/base/options/retired.hpp"

namespace liana::options {
namespace {

constexpr std::size_t kMaxEdits = 2;

// Words of command lines, and shipped poses.
constexpr std::array<RetiredName, 5> kRetired{{
    {"human", "model"},
    {"--way-out", "--retract-path"},
    {"fixture", "jig"},
    {"fixture_a", "jig_a"},
    {"fixture_b", "jig_b"},
}};

// Fewest edits that make one word of the other, no letter edited twice (optimal string alignment).
std::size_t edits_between(std::string_view a, std::string_view b) {
  std::vector<std::vector<std::size_t>> edits(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
  for (std::size_t i = 0; i <= a.size(); ++i) {
    for (std::size_t j = 0; j <= b.size(); ++j) {
      if (i == 0 || j == 0) {
        edits[i][j] = i + j;
        continue;
      }
      edits[i][j] =
          std::min({edits[i - 1][j] + 1, edits[i][j - 1] + 1, edits[i - 1][j - 1] + (a[i - 1] == b[j - 1] ? 0u : 1u)});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        edits[i][j] = std::min(edits[i][j], edits[i - 2][j - 2] + 1);
    }
  }
  return edits.back().back();
}

}  // namespace

std::string nearest(std::string_view given, const std::vector<std::string>& known) {
  std::string found;
  const std::size_t letters = given.size() - std::min(given.find_first_not_of('-'), given.size());
  std::size_t fewer_than = std::min(kMaxEdits, letters / 2) + 1;
  for (const std::string& name : known) {
    if (name.size() > given.size() + kMaxEdits || given.size() > name.size() + kMaxEdits) continue;
    const std::size_t edits = edits_between(given, name);
    if (edits >= fewer_than) continue;
    fewer_than = edits;
    found = name;
  }
  return found;
}

std::string did_you_mean(std::string_view given, const std::vector<std::string>& known) {
  const std::string now{present_name(given, kRetired)};
  if (std::find(known.begin(), known.end(), now) != known.end()) return "; " + called_now(now);
  const std::string name = nearest(given, known);
  return name.empty() ? "" : "; did you mean " + name + "?";
}

std::string allowed_names(std::string_view given, const std::vector<std::string>& known, std::string_view more) {
  std::string list;
  for (const std::string& name : known) list += (list.empty() ? "" : ", ") + name;
  return list.append(more) + did_you_mean(given, known);
}

}  // namespace liana::options
