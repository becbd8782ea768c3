// Kills the writer of an archive (SIGKILL) `--count` times at random moments. It tells of each event and refused
// command as soon as it counts as durable; a reader looks right before the kill. Afterwards all that was told or seen
// has to be there, and every file whole. Each writer goes on in the folder of the one before, as a life of its own.
// Ends with exit code 1 when anything is lost.
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "host/base/json/json.hpp"
#include "host/storage/archive/check.hpp"
#include "host/storage/archive/reader.hpp"
#include "host/storage/archive/recorder.hpp"
#include "tests/numbers/options.hpp"

namespace liana::numbers {
namespace {

namespace fs = std::filesystem;

constexpr double kPeriod_s = 0.004;
constexpr int kInterval = 5;
constexpr int kLongest_ms = 300;  // of a writer's life

Json state(std::uint64_t tick, std::uint64_t command) {
  return {{"op", "state"},
          {"tick", tick},
          {"time_s", static_cast<double>(tick) * kPeriod_s},
          {"state", "ENABLED"},
          {"measured_js_deg", {1.0, 2.0, 3.0}},
          {"verdict", {{"sequence", command}, {"released", false}, {"code", 104}}}};
}

Json event(std::uint64_t sequence, std::uint64_t tick) {
  return {{"op", "event"},     {"sequence", sequence},     {"tick", tick},    {"kind", "step"}, {"number", 1},
          {"subject", "step"}, {"values", Json::object()}, {"text", "step 1"}};
}

// One refused command and one event after the other for as long as it lives; each is told to `out` once it is durable.
// Telemetry files last two seconds of arm time, so that some are killed as they begin.
[[noreturn]] void write_for_ever(const std::string& folder, int out) {
  archive::Recorder recorder(folder, {"hash", "{}", "{}", "{}", "fast", kPeriod_s, "", "numbers"}, kInterval,
                             {.file_s = 2.0});
  for (std::uint64_t n = 1;; ++n) {
    const std::uint64_t tick = n * kInterval;
    recorder.take(state(tick, n));
    recorder.take(event(n, tick));
    if (recorder.durable() < 2 * n) _exit(3);
    if (write(out, &n, sizeof n) != sizeof n) _exit(4);
  }
}

// What was known of a writer when it was killed.
struct Known {
  std::uint64_t told = 0;  // the last number that it told
  std::uint64_t seen = 0;  // the last event that another process read
};

std::uint64_t newest_event(const std::string& folder) {
  const std::vector<event::Event> events = archive::Reader(folder).events();
  return events.empty() ? 0 : events.back().sequence;
}

Known kill_one(const std::string& folder, int after_ms) {
  int ends[2];
  if (pipe(ends) != 0) std::abort();
  const pid_t child = fork();
  if (child == 0) write_for_ever(folder, ends[1]);
  close(ends[1]);
  Known known;
  std::uint64_t read_in = 0;
  if (read(ends[0], &read_in, sizeof read_in) == sizeof read_in) known.told = read_in;  // it has begun
  usleep(static_cast<useconds_t>(after_ms) * 1000);
  known.seen = newest_event(folder);
  kill(child, SIGKILL);
  while (read(ends[0], &read_in, sizeof read_in) == sizeof read_in) known.told = read_in;
  close(ends[0]);
  waitpid(child, nullptr, 0);
  return known;
}

std::uint64_t missing_in(const std::string& folder, const Known& known) {
  const archive::Reader reader(folder);
  std::set<std::uint64_t> events, commands;
  for (const event::Event& each : reader.events()) events.insert(each.sequence);
  for (const archive::Command& each : reader.commands(archive::kAll, true)) commands.insert(each.sequence);
  std::uint64_t missing = known.told == 0 || known.seen == 0 ? 1 : 0;  // a writer that never began is no test
  for (std::uint64_t n = 1; n <= std::max(known.told, known.seen); ++n) missing += events.contains(n) ? 0u : 1u;
  for (std::uint64_t n = 1; n <= known.told; ++n) missing += commands.contains(n) ? 0u : 1u;
  return missing;
}

int run(const Options& options) {
  const std::string folder = fs::temp_directory_path() / ("liana-archive-kills-" + std::to_string(getpid()));
  fs::create_directories(folder);
  std::mt19937_64 generator(1);
  std::uint64_t rows = 0, missing = 0;
  for (int i = 0; i < options.count; ++i) {
    const Known known = kill_one(folder, static_cast<int>(generator() % kLongest_ms));
    missing += missing_in(folder, known);
    rows += 2 * known.told;
  }
  const archive::Check check = archive::check(folder);
  const bool good = missing == 0 && check.problems.empty();
  const Json result{{"kills", options.count},      {"acknowledged", rows},       {"missing", missing},
                    {"lives", check.lives.size()}, {"problems", check.problems}, {"good", good}};
  std::puts(result.dump(options.json ? -1 : 1).c_str());
  if (good) fs::remove_all(folder);
  return good ? 0 : 1;
}

}  // namespace
}  // namespace liana::numbers

int main(int argc, char** argv) { return liana::numbers::run(liana::numbers::parse_options(argc, argv, 100)); }
