#include <cinttypes>
#include <cstdio>
#include <filesystem>
#include <stdexcept>

#include "host/apps/cli/commands.hpp"
#include "host/apps/cli/run_choice.hpp"
#include "host/apps/launcher/errors.hpp"
#include "host/base/json/json.hpp"
#include "host/storage/recording/images_check.hpp"
#include "host/storage/recording/recording.hpp"
#include "host/storage/recording/replay.hpp"

namespace liana::cli {
namespace {

void print_json(const recording::ReplayResult& result, const recording::ImagesCheck& images) {
  std::puts(Json{{"ticks", result.ticks},
                 {"differing_ticks", result.differing_ticks},
                 {"missing_ticks", result.missing_ticks},
                 {"complete", result.complete},
                 {"same_build", result.same_build},
                 {"recorded_by", result.recorded_by},
                 {"first_differing_tick", result.differing_ticks > 0 ? Json(result.first_differing_tick) : nullptr},
                 {"first_differing_field", result.first_differing_field},
                 {"compared", {recording::kRecordingFile}},
                 {"images", {{"file", recording::kImagesFile}, {"state", images.state}, {"count", images.count}}}}
                .dump()
                .c_str());
}

void print_text(const recording::ReplayResult& result, const recording::ImagesCheck& images) {
  std::printf("%" PRIu64 " ticks, %" PRIu64 " differ\n", result.ticks, result.differing_ticks);
  if (result.differing_ticks > 0) {
    std::printf("first: tick %" PRIu64 ", field %s\n", result.first_differing_tick,
                result.first_differing_field.c_str());
  }
  if (result.missing_ticks > 0) std::printf("%" PRIu64 " ticks are missing in the recording\n", result.missing_ticks);
  std::printf("compared: %s, every field of Outputs\n", recording::kRecordingFile);
  if (images.state == "whole") {
    std::printf("checked: %s, its checksums, and that each of its %" PRIu64 " images can be read\n",
                recording::kImagesFile, images.count);
  } else if (images.good()) {
    std::printf("not there, so not checked: %s\n", recording::kImagesFile);
  }
  std::printf("recorded by %s build (%s)\n", result.same_build ? "this" : "another", result.recorded_by.c_str());
}

}  // namespace

int replay_command(const ReplayOptions& options) {
  const std::string directory = named_run("replay", options.directory);
  const std::filesystem::path file = std::filesystem::path(directory) / recording::kRecordingFile;
  if (!std::filesystem::exists(file)) {
    throw launcher::BadInput("replay: '" + directory + "': holds no " + recording::kRecordingFile +
                             "; give a directory that liana run --record wrote");
  }
  const recording::ReplayResult result = recording::replay(directory);
  const recording::ImagesCheck images = recording::check_images(directory, result.is_serial);
  if (options.json) {
    print_json(result, images);
  } else {
    print_text(result, images);
  }
  if (!result.complete) {
    std::fprintf(stderr,
                 "liana: %s: the recording was cut short: the file ends before its end record, so nothing says how "
                 "much is missing; "
                 "the ticks that are there were compared\n",
                 file.c_str());
  }
  if (result.complete && result.ticks + result.missing_ticks == 0) {
    std::fprintf(stderr,
                 "liana: %s: no tick was recorded: the core ticks only once all drives are booted; report.json beside "
                 "it says why\n",
                 file.c_str());
  }
  if (!images.good()) {
    std::fprintf(stderr, "liana: %s/%s: %s; take a good copy of the file: a replay from mid-run needs it\n",
                 directory.c_str(), recording::kImagesFile, images.state.c_str());
  }
  return result.complete && images.good() && result.ticks > 0 && result.differing_ticks == 0 ? launcher::kExitOk
                                                                                             : launcher::kExitFailure;
}

}  // namespace liana::cli
