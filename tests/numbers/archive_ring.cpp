// The control-rate ring of `--count` seconds (86,400: a day) at 250 Hz in accelerated time, with a fault every hour.
// Its ticks are those of a recorded run again and again (`--recording DIR`); without one those of the core on readings
// that scatter. Ends with exit code 1 when a tick is missing, a file is not whole, or a day would take more than
// kMost_bytes.
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <functional>
#include <random>
#include <string>
#include <string_view>
#include <vector>

#include "host/base/json/json.hpp"
#include "host/storage/archive/ring.hpp"
#include "host/storage/archive/ring_reader.hpp"
#include "host/storage/recording/codec.hpp"
#include "host/storage/recording/mcap.hpp"
#include "host/storage/recording/recording.hpp"
#include "tests/host/storage/archive/ring_ticks.hpp"
#include "tests/numbers/options.hpp"

namespace liana::numbers {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr double kPeriod_s = 0.004;
constexpr std::uint64_t kSecond = 250, kImageTicks = 1000, kMinutes = 100;  // kMinutes: that are read again
constexpr double kDay_s = 86400.0, kMost_bytes = 1.5e9;
constexpr std::uint64_t kSynthetic = 60 * kSecond;

double seconds_since(Clock::time_point begin) { return std::chrono::duration<double>(Clock::now() - begin).count(); }

// What is fed again and again.
struct Source {
  std::string image;                 // a packet
  std::vector<std::string> packets;  // of ticks, one after the other
};

std::string packet_of(const recording::RecordedCounts& counts, std::string_view inputs, std::string_view outputs) {
  std::string out;
  recording::Writer writer(out);
  writer("kind", recording::TickPacket::kTick);
  writer("dropped", std::uint64_t{0});
  writer("drives", counts.drives);
  writer("thetas", counts.thetas);
  writer("segments", counts.segments);
  writer("inputs_bytes", static_cast<std::uint32_t>(inputs.size()));
  return out.append(inputs).append(outputs);
}

Source recorded(const std::string& folder) {
  Source source;
  recording::RecordedCounts counts;
  std::string inputs;
  recording::McapVisitor visitor;
  visitor.message = [&](const std::string& topic, std::uint32_t, std::uint64_t, std::string_view data) {
    if (topic == recording::kStartTopic)
      counts = recording::counts_of(recording::parse_image<cable::CableArm>(data).table);
    if (topic == recording::kInputsTopic) inputs = data;
    if (topic == recording::kOutputsTopic) source.packets.push_back(packet_of(counts, inputs, data));
    if (topic == recording::kImageTopic) source.image = std::string(1, '\x02').append(data);
  };
  recording::read_mcap(folder + "/" + recording::kRecordingFile, visitor);
  recording::read_mcap(folder + "/" + recording::kImagesFile, visitor);
  return source;
}

Source synthetic() {
  Source source;
  archive::RingTicks ticks;
  while (source.packets.size() < kSynthetic) source.packets.push_back(ticks.next());
  source.image = ticks.image();
  return source;
}

void put_tick(std::string& packet, std::size_t at, std::uint64_t tick) {
  for (std::size_t i = 0; i < sizeof tick; ++i) packet[at + i] = static_cast<char>(tick >> (8 * i));
}

// The same at another tick.
std::string moved(const std::string& packet, std::uint64_t tick) {
  const recording::TickParts parts = recording::split_tick_packet(packet);
  std::string out = packet;
  put_tick(out, static_cast<std::size_t>(parts.inputs.data() - packet.data()), tick);
  put_tick(out, static_cast<std::size_t>(parts.outputs.data() - packet.data()), tick);
  return out;
}

struct Written {
  double seconds = 0.0;
  std::uint64_t gaps = 0, missing = 0, most_bytes = 0;
};

Written write_ring(const std::string& folder, const Source& source, std::uint64_t ticks) {
  const auto begin = Clock::now();
  Written written;
  archive::Ring ring(folder, 1, {"hash", "{}", "{}", "{}", "fast", kPeriod_s, "", "numbers"}, {},
                     [&](const archive::Gap&) { ++written.gaps; });
  for (std::uint64_t tick = 0; tick < ticks; ++tick) {
    if (tick % kImageTicks == 0) {
      std::string image = source.image;
      put_tick(image, 1, tick);
      ring.take(image);
    }
    ring.take(moved(source.packets[tick % source.packets.size()], tick));
    if (tick % (3600 * kSecond) == 1800 * kSecond) ring.keep_around(tick);
    if (tick % (60 * kSecond) == 0)
      written.most_bytes = std::max(written.most_bytes, archive::RingReader(folder, 1).bytes());
  }
  ring.finish();
  written.most_bytes = std::max(written.most_bytes, archive::RingReader(folder, 1).bytes());
  written.missing = ring.missing();
  written.seconds = seconds_since(begin);
  return written;
}

struct Minutes {
  double median_ms = 0.0, worst_ms = 0.0;
  bool all_there = true;
};

// Each by a reader of its own, at random.
Minutes read_minutes(const std::string& folder, std::uint64_t ticks) {
  std::mt19937_64 generator(2);
  std::vector<double> took_ms;
  Minutes minutes;
  const std::uint64_t length = std::min(60 * kSecond, ticks);
  for (std::uint64_t i = 0; i < kMinutes; ++i) {
    const std::uint64_t first = generator() % (ticks - length + 1);
    const auto begin = Clock::now();
    std::uint64_t found = 0;
    archive::RingVisitor visitor;
    visitor.tick = [&](const archive::RingAbout&, const archive::RingTick&) { ++found; };
    archive::RingReader(folder, 1).visit({first, first + length - 1}, visitor);
    took_ms.push_back(seconds_since(begin) * 1e3);
    minutes.all_there = minutes.all_there && found == length;
  }
  std::sort(took_ms.begin(), took_ms.end());
  minutes.median_ms = took_ms[took_ms.size() / 2];
  minutes.worst_ms = took_ms.back();
  return minutes;
}

struct Bytes {
  std::uint64_t inputs = 0, outputs = 0, kept = 0;
};

Bytes bytes_in(const std::string& folder) {
  Bytes bytes;
  for (const archive::RingFile& file : archive::ring_files(folder)) {
    const bool is_inputs = file.kind == archive::RingKind::kInputs;
    (is_inputs ? bytes.inputs : bytes.outputs) += archive::bytes_of(file);
    if (file.kind == archive::RingKind::kKept) bytes.kept += archive::bytes_of(file);
  }
  return bytes;
}

int run(const Options& options, const std::string& recording) {
  const std::uint64_t seconds = static_cast<std::uint64_t>(options.count), ticks = seconds * kSecond;
  const std::string folder = fs::temp_directory_path() / ("liana-archive-ring-" + std::to_string(getpid()));
  fs::create_directories(folder);
  const Written written = write_ring(folder, recording.empty() ? synthetic() : recorded(recording), ticks);
  const Minutes minutes = read_minutes(folder, ticks);
  const auto checking = Clock::now();
  std::vector<std::string> problems;
  const archive::RingCheck check = archive::check_ring(folder, 1, problems);
  const double checked_in_s = seconds_since(checking);
  const Bytes bytes = bytes_in(folder);
  fs::remove_all(folder);
  const double inputs_a_tick = static_cast<double>(bytes.inputs) / static_cast<double>(check.ticks);
  const double outputs_a_tick = static_cast<double>(bytes.outputs) / static_cast<double>(check.full_ticks);
  const archive::RingLimits limits;
  const double full_s = limits.full_s + 2.0 * limits.outputs_file_s;
  const double faults_bytes = kDay_s / 3600.0 * 2.0 * limits.outputs_file_s / kPeriod_s * outputs_a_tick;
  const double a_day = (kDay_s * inputs_a_tick + full_s * outputs_a_tick) / kPeriod_s + faults_bytes;
  const bool good = problems.empty() && minutes.all_there && written.gaps == 0 && written.missing == 0 &&
                    check.missing == 0 && check.ticks == ticks && check.cut_short == 0 && a_day <= kMost_bytes &&
                    static_cast<double>(written.most_bytes) <= kMost_bytes;
  const Json result{{"seconds", seconds},
                    {"source", recording.empty() ? "core on readings that scatter" : "recorded run"},
                    {"ticks", check.ticks},
                    {"full_ticks", check.full_ticks},
                    {"files", check.files},
                    {"images", check.images},
                    {"whole", problems.empty()},
                    {"gaps", written.gaps},
                    {"missing", check.missing},
                    {"inputs_bytes_a_tick", inputs_a_tick},
                    {"outputs_bytes_a_tick", outputs_a_tick},
                    {"kept_bytes", bytes.kept},
                    {"most_bytes", written.most_bytes},
                    {"bytes_a_day", a_day},
                    {"written_in_s", written.seconds},
                    {"us_a_tick", written.seconds * 1e6 / static_cast<double>(ticks)},
                    {"minute_median_ms", minutes.median_ms},
                    {"minute_worst_ms", minutes.worst_ms},
                    {"checked_in_s", checked_in_s},
                    {"good", good}};
  std::puts(result.dump(options.json ? -1 : 1).c_str());
  return good ? 0 : 1;
}

}  // namespace
}  // namespace liana::numbers

int main(int argc, char** argv) {
  std::string recording;
  if (argc > 2 && std::string_view(argv[1]) == "--recording") {
    recording = argv[2];
    argv[2] = argv[0];
    argc -= 2;
    argv += 2;
  }
  return liana::numbers::run(liana::numbers::parse_options(argc, argv, 86400), recording);
}
