// bits_tape: makes tapes of recordings, compares answers, sums up counts. `./dev bits` calls it; every command prints
// JSON.
#include <CLI/CLI.hpp>
#include <fstream>
#include <iostream>

#include "host/json/json.hpp"
#include "tests/bits/compare.hpp"
#include "tests/bits/make_tape.hpp"
#include "tests/bits/meter.hpp"

namespace liana::bits {
namespace {

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

}  // namespace
}  // namespace liana::bits

int main(int argc, char** argv) {
  CLI::App app("tapes for ./dev bits");
  app.require_subcommand(1);
  std::vector<std::string> recordings;
  std::string first, second;
  liana::bits::TapeOptions options;
  CLI::App* const make = app.add_subcommand("make", "write a tape and the Outputs expected of it");
  make->add_option("--apart", options.apart, "ticks between branches")->check(CLI::PositiveNumber);
  make->add_option("--limit", options.limit, "most ticks of each recording");
  make->add_option("--flip-at", options.flip_at, "falsify one bit of this recorded tick");
  make->add_option("tape", first)->required();
  make->add_option("expected", second)->required();
  make->add_option("recordings", recordings)->required();
  CLI::App* const cases = app.add_subcommand(
      "cases", "write a tape of costly cases (tests/bench/worst_cases.hpp) and the Outputs expected of it");
  std::string case_file;
  cases->add_option("tape", first)->required();
  cases->add_option("expected", second)->required();
  cases->add_option("cases", case_file)->required()->check(CLI::ExistingFile);
  CLI::App* const compare = app.add_subcommand("compare", "compare answered with expected Outputs");
  compare->add_option("expected", first)->required()->check(CLI::ExistingFile);
  compare->add_option("answered", second)->required()->check(CLI::ExistingFile);
  CLI::App* const meter = app.add_subcommand("meter", "what the Cortex-M7 counted");
  meter->add_option("outputs", first)->required()->check(CLI::ExistingFile);
  meter->add_option("meter", second)->required()->check(CLI::ExistingFile);
  CLI11_PARSE(app, argc, argv);
  try {
    if (make->parsed()) {
      liana::bits::TapeSummary summary;
      std::ofstream tape(first, std::ios::binary), expected(second, std::ios::binary);
      for (const std::string& directory : recordings)
        liana::bits::append_recording(directory, options, tape, expected, summary);
      std::cout << liana::bits::tape_json(summary) << "\n";
      return 0;
    }
    if (cases->parsed()) {
      std::ifstream lines(case_file);
      std::ofstream tape(first, std::ios::binary), expected(second, std::ios::binary);
      std::cout << liana::Json{{"ticks", liana::bits::append_cases(lines, tape, expected)}}.dump() << "\n";
      return 0;
    }
    std::ifstream one(first, std::ios::binary), other(second, std::ios::binary);
    std::cout << (compare->parsed() ? liana::bits::comparison_json(liana::bits::compare(one, other))
                                    : liana::bits::meter_json(liana::bits::summarise(one, other)))
              << "\n";
    return 0;
  } catch (const std::exception& reason) {
    std::cerr << "bits_tape: " << reason.what() << "\n";
    return 1;
  }
}
