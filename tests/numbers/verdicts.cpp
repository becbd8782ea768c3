// verdicts [--count SEEDS] [--json]: the corpus of commands with known verdicts, drawn anew from seeds that no test
// has.
#include <cstdio>
#include <cstdlib>
#include <string>

#include "tests/host/control/verification/corpus.hpp"
#include "tests/numbers/options.hpp"

namespace {

using namespace liana::verification;

constexpr std::uint64_t kFirstSeed = 5001;

struct Count {
  int commands = 0, wrong_accepts = 0, wrong_refusals = 0, other_code = 0;
};

Count count(const corpus::Class& one, std::uint64_t seeds) {
  Count found;
  for (std::uint64_t seed = kFirstSeed; seed < kFirstSeed + seeds; ++seed) {
    for (const corpus::Command& command : one.commands(seed)) {
      const SimulationVerdict verdict = corpus::verdict_of(command);
      const bool has_to_pass = command.expected == Refusal::kNone;
      ++found.commands;
      found.wrong_accepts += verdict.passed() && !has_to_pass ? 1 : 0;
      found.wrong_refusals += !verdict.passed() && has_to_pass ? 1 : 0;
      found.other_code += !verdict.passed() && !has_to_pass && verdict.code != command.expected ? 1 : 0;
      if (verdict.code != command.expected)
        std::fprintf(stderr, "seed %llu, %s: %s\n", static_cast<unsigned long long>(seed), command.name.c_str(),
                     verdict.text.c_str());
    }
  }
  return found;
}

bool run(const liana::numbers::Options& options) {
  bool good = true, first = true;
  for (const corpus::Class& one : corpus::kClasses) {
    const Count found = count(one, static_cast<std::uint64_t>(options.count));
    good = good && found.wrong_accepts == 0 && 100 * found.wrong_refusals <= found.commands;
    const char* format =
        options.json
            ? "%s{\"class\":\"%s\",\"commands\":%d,\"wrong_accepts\":%d,\"wrong_refusals\":%d,\"other_code\":%d}"
            : "%s%-10s %5d commands, %d wrong accepts, %d wrong refusals, %d refused for another reason\n";
    std::printf(format, !options.json ? "" : (first ? "[" : ","), one.name, found.commands, found.wrong_accepts,
                found.wrong_refusals, found.other_code);
    first = false;
  }
  if (options.json) std::puts("]");
  return good;
}

}  // namespace

int main(int argc, char** argv) { return run(liana::numbers::parse_options(argc, argv, 100)) ? 0 : 1; }
