#include <cinttypes>
#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "host/cli/commands.hpp"
#include "host/cli/errors.hpp"
#include "host/record/recording.hpp"
#include "host/record/replay.hpp"

namespace liana {
namespace {

void print_json(const ReplayResult& result) {
  std::puts(nlohmann::json{{"ticks", result.ticks},
                           {"differing_ticks", result.differing_ticks},
                           {"missing_ticks", result.missing_ticks},
                           {"complete", result.complete},
                           {"same_build", result.same_build},
                           {"recorded_by", result.recorded_by},
                           {"first_differing_tick", result.differing_ticks > 0 ? nlohmann::json(result.first_differing_tick) : nullptr},
                           {"first_differing_field", result.first_differing_field}}
                .dump()
                .c_str());
}

void print_text(const ReplayResult& result) {
  std::printf("%" PRIu64 " ticks, %" PRIu64 " differ\n", result.ticks, result.differing_ticks);
  if (result.differing_ticks > 0) {
    std::printf("first: tick %" PRIu64 ", field %s\n", result.first_differing_tick, result.first_differing_field.c_str());
  }
  if (result.missing_ticks > 0) std::printf("%" PRIu64 " ticks are missing in the recording\n", result.missing_ticks);
  std::printf("recorded by %s build (%s)\n", result.same_build ? "this" : "another", result.recorded_by.c_str());
}

}  // namespace

int replay_command(const ReplayOptions& options) {
  const std::filesystem::path file = std::filesystem::path(options.directory) / kRecordingFile;
  if (!std::filesystem::exists(file)) {
    throw BadInput("replay: '" + options.directory + "': holds no " + kRecordingFile + "; give a directory that liana run --record wrote");
  }
  const ReplayResult result = replay(options.directory);
  if (options.json) {
    print_json(result);
  } else {
    print_text(result);
  }
  if (!result.complete) {
    std::fprintf(stderr,
                 "liana: %s: the recording was cut short: the file ends before its end record, so nothing says how much is missing; "
                 "the ticks that are there were compared\n",
                 file.c_str());
  }
  return result.complete && result.ticks > 0 && result.differing_ticks == 0 ? kExitOk : kExitFailure;
}

}  // namespace liana
