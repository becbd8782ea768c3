#include "host/operator/simulated/hand_recording.hpp"
#include "host/base/file/in_file.hpp"

#include <charconv>
#include <cmath>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string_view>

namespace liana::simulated {
namespace {

constexpr double kUnitTolerance = 1e-4;  // quaternions are written with six decimals
constexpr std::size_t kVrColumns = 19;
constexpr std::size_t kHandColumns = 10;

// One line of a file, split at blanks, with messages that say where it is.
struct Line {
  const std::string& file;
  std::size_t number;
  std::vector<std::string> words;

  [[noreturn]] void fail(const std::string& what) const {
    throw std::runtime_error(file + ": line " + std::to_string(number) + ": " + what);
  }

  double real(std::size_t column, const char* name) const {
    const std::string& word = words[column];
    double value = 0.0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc{} || end != word.data() + word.size() || !std::isfinite(value)) {
      fail(std::string(name) + ": \"" + word +
           "\": allowed a finite decimal number; correct the file or record it again");
    }
    return value;
  }

  bool flag(std::size_t column, const char* name) const {
    const double value = real(column, name);
    if (value != 0.0 && value != 1.0)
      fail(std::string(name) + ": " + words[column] + ": allowed 0 or 1; correct the file");
    return value == 1.0;
  }

  double trigger(std::size_t column, const char* name) const {
    const double value = real(column, name);
    if (value < 0.0 || value > 1.0) fail(std::string(name) + ": " + words[column] + ": allowed 0..1; correct the file");
    return value;
  }

  Pose pose(std::size_t column, const char* name) const {
    Pose pose;
    for (std::size_t i = 0; i < 3; ++i) pose.position_m[i] = real(column + i, name);
    double square = 0.0;
    for (std::size_t i = 0; i < 4; ++i) {
      pose.quaternion[i] = real(column + 3 + i, name);
      square += pose.quaternion[i] * pose.quaternion[i];
    }
    if (std::fabs(std::sqrt(square) - 1.0) > kUnitTolerance) {
      fail(std::string(name) + ": quaternion of length " + std::to_string(std::sqrt(square)) +
           ": allowed 1 within 1e-4; write qw qx qy qz");
    }
    pose.quaternion = normalize(pose.quaternion);
    return pose;
  }

  std::int64_t time_us() const {
    const double value = real(0, "t_us");
    if (value < 0.0 || value > 1e12 || value != std::floor(value)) {
      fail("t_us: " + words[0] + ": allowed whole microseconds 0..1e12; correct the file");
    }
    return static_cast<std::int64_t>(value);
  }

  void need(std::size_t columns) const {
    if (words.size() != columns) {
      fail(std::to_string(words.size()) + " columns: allowed exactly " + std::to_string(columns) +
           "; see docs/reference/formats.md");
    }
  }
};

BothHands vr_sample(const Line& line) {
  line.need(kVrColumns);
  BothHands hands;
  hands.right.t_us = hands.left.t_us = line.time_us();
  hands.right.valid = line.flag(1, "right_valid");
  hands.right.trigger = line.trigger(2, "right_trigger");
  hands.right.pose = line.pose(3, "right pose");
  hands.left.valid = line.flag(10, "left_valid");
  hands.left.trigger = line.trigger(11, "left_trigger");
  hands.left.pose = line.pose(12, "left pose");
  hands.right.deadman = hands.right.trigger >= kGripped;
  hands.left.deadman = hands.left.trigger >= kGripped;
  return hands;
}

device::Sample hand_sample(const Line& line) {
  line.need(kHandColumns);
  return {.t_us = line.time_us(),
          .valid = line.flag(1, "valid"),
          .deadman = line.flag(2, "button"),
          .pose = line.pose(3, "pose")};
}

std::int64_t time_us(const BothHands& hands) { return hands.right.t_us; }
std::int64_t time_us(const device::Sample& sample) { return sample.t_us; }

std::vector<std::string> split(const std::string& text) {
  std::istringstream stream(text.substr(0, text.find('#')));
  std::vector<std::string> words;
  for (std::string word; stream >> word;) words.push_back(word);
  return words;
}

template <class Sample>
void append(std::vector<Sample>& samples, const Sample& sample, const Line& line) {
  if (samples.empty() && time_us(sample) != 0)
    line.fail("t_us: " + line.words[0] + ": allowed 0 for the first sample; shift the times");
  if (!samples.empty() && time_us(sample) <= time_us(samples.back())) {
    line.fail("t_us: " + line.words[0] + ": allowed more than " + std::to_string(time_us(samples.back())) +
              " of the line before; sort the file");
  }
  samples.push_back(sample);
}

template <class Sample>
std::vector<Sample> read_samples(std::istream& stream, const std::string& path, std::size_t number,
                                 Sample (*convert)(const Line&)) {
  std::vector<Sample> samples;
  for (std::string text; std::getline(stream, text);) {
    const Line line{path, ++number, split(text)};
    if (!line.words.empty()) append(samples, convert(line), line);
  }
  if (samples.empty()) throw std::runtime_error(path + ": no samples: allowed at least one; record it again");
  return samples;
}

}  // namespace

std::variant<VrRecording, HandRecording> read_hand_recording(const std::string& path) {
  file::require_ordinary(path);
  std::ifstream stream(path);
  if (!stream) throw std::runtime_error(path + ": cannot be read; give an existing .hand file");
  return parse_hand_recording(stream, path);
}

std::variant<VrRecording, HandRecording> parse_hand_recording(std::istream& stream, const std::string& path) {
  std::string text;
  std::getline(stream, text);
  const Line header{path, 1, split(text)};
  const bool known = header.words.size() == 3 && header.words[0] == "liana-hand" && header.words[1] == "1";
  if (known && header.words[2] == "vr") return read_samples<BothHands>(stream, path, 1, vr_sample);
  if (known && header.words[2] == "hand") return read_samples<device::Sample>(stream, path, 1, hand_sample);
  header.fail("\"" + text.substr(0, 40) +
              "\": allowed \"liana-hand 1 vr\" or \"liana-hand 1 hand\"; this is not a hand recording of format 1");
}

VrRecording read_vr_recording(const std::string& path) {
  auto recording = read_hand_recording(path);
  if (auto* vr = std::get_if<VrRecording>(&recording)) return std::move(*vr);
  throw std::runtime_error(path +
                           ": holds a hand controller: allowed VR handles (liana-hand 1 vr); choose another recording");
}

HandRecording read_hand_controller_recording(const std::string& path) {
  auto recording = read_hand_recording(path);
  if (auto* hand = std::get_if<HandRecording>(&recording)) return std::move(*hand);
  throw std::runtime_error(
      path + ": holds VR handles: allowed a hand controller (liana-hand 1 hand); choose another recording");
}

}  // namespace liana::simulated
