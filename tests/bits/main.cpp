// bits_tape: makes tapes of recordings, compares answers, sums up counts. `./dev bits` calls it; every command prints
// JSON.
#include <CLI/CLI.hpp>
#include <fstream>
#include <iostream>

#include "host/base/json/json.hpp"
#include "tests/bits/compare.hpp"
#include "tests/bits/make_tape.hpp"
#include "tests/bits/meter.hpp"

namespace liana::bits {
namespace {

struct Words {
  std::string arm = "cable", first, second, cases;
  std::vector<std::string> recordings;
  TapeOptions options;
};

std::string tape_json(const TapeSummary& summary) {
  Json faults = Json::array(), missing = Json::array();
  for (const FaultInfo& info : all_faults()) {
    if (info.number != FaultNumber::kNone)
      (summary.faults.contains(info.number) ? faults : missing).push_back(static_cast<int>(info.number));
  }
  return Json{{"mission_ticks", summary.mission_ticks},
              {"what_if_ticks", summary.what_if_ticks},
              {"what_ifs", summary.what_ifs},
              {"faults", faults},
              {"faults_not_reached", missing}}
      .dump();
}

std::string comparison_json(const Comparison& result) {
  Json json{{"ticks", result.ticks}, {"differing_ticks", result.differing_ticks}};
  if (result.differing_ticks > 0) {
    json["first"] = {{"place", result.first_place}, {"tick", result.first_tick}, {"field", result.first_field}};
  }
  return json.dump();
}

std::string meter_json(const MeterSummary& meter) {
  return Json{{"ticks", meter.ticks},
              {"median_instructions", meter.median_instructions},
              {"worst_instructions", meter.worst_instructions},
              {"worst_tick", meter.worst_tick},
              {"worst_state", meter.worst_state},
              {"worst_stack_bytes", meter.worst_stack_bytes}}
      .dump();
}

template <class Arm>
std::string made(const Words& words) {
  TapeSummary summary;
  std::ofstream tape(words.first, std::ios::binary), expected(words.second, std::ios::binary);
  for (const std::string& directory : words.recordings)
    append_recording<Arm>(directory, words.options, tape, expected, summary);
  return tape_json(summary);
}

std::string cases_made(const Words& words) {
  std::ifstream lines(words.cases);
  std::ofstream tape(words.first, std::ios::binary), expected(words.second, std::ios::binary);
  return Json{{"ticks", append_cases(lines, tape, expected)}}.dump();
}

template <class Arm>
std::string answer(const std::string& command, const Words& words) {
  if (command == "make") return made<Arm>(words);
  std::ifstream one(words.first, std::ios::binary), other(words.second, std::ios::binary);
  return command == "compare" ? comparison_json(compare<Arm>(one, other)) : meter_json(summarise<Arm>(one, other));
}

void declare(CLI::App& app, Words& words) {
  app.require_subcommand(1);
  CLI::App* const make = app.add_subcommand("make", "write a tape and the Outputs expected of it");
  make->add_option("--apart", words.options.apart, "ticks between branches")->check(CLI::PositiveNumber);
  make->add_option("--limit", words.options.limit, "most ticks of each recording");
  make->add_option("--flip-at", words.options.flip_at, "falsify one bit of this recorded tick");
  make->add_option("tape", words.first)->required();
  make->add_option("expected", words.second)->required();
  make->add_option("recordings", words.recordings)->required();
  CLI::App* const cases = app.add_subcommand(
      "cases", "write a tape of costly cases (tests/benchmarks/worst_cases.hpp) and the Outputs expected of it");
  cases->add_option("tape", words.first)->required();
  cases->add_option("expected", words.second)->required();
  cases->add_option("cases", words.cases)->required()->check(CLI::ExistingFile);
  CLI::App* const compare = app.add_subcommand("compare", "compare answered with expected Outputs");
  compare->add_option("expected", words.first)->required()->check(CLI::ExistingFile);
  compare->add_option("answered", words.second)->required()->check(CLI::ExistingFile);
  CLI::App* const meter = app.add_subcommand("meter", "what the Cortex-M7 counted");
  meter->add_option("outputs", words.first)->required()->check(CLI::ExistingFile);
  meter->add_option("meter", words.second)->required()->check(CLI::ExistingFile);
  for (CLI::App* const command : {make, compare, meter})
    command->add_option("--arm", words.arm, "kind of arm")
        ->check(CLI::IsMember({"cable", "serial"}))
        ->capture_default_str();
}

}  // namespace
}  // namespace liana::bits

int main(int argc, char** argv) {
  CLI::App app("tapes for ./dev bits");
  liana::bits::Words words;
  liana::bits::declare(app, words);
  CLI11_PARSE(app, argc, argv);
  try {
    const std::string command = app.get_subcommands().front()->get_name();
    const auto answer = words.arm == "serial" ? liana::bits::answer<liana::serial::SerialArm>
                                              : liana::bits::answer<liana::cable::CableArm>;
    std::cout << (command == "cases" ? liana::bits::cases_made(words) : answer(command, words)) << "\n";
    return 0;
  } catch (const std::exception& reason) {
    std::cerr << "bits_tape: " << reason.what() << "\n";
    return 1;
  }
}
