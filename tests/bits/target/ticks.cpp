// bits_ticks: runs the tape in the working directory through the core it is linked with, and writes the Outputs of
// every tick.
#include <cstdio>
#include <cstdlib>
#include <optional>
#include <string>

#include "host/storage/recording/serialise.hpp"
#include "tests/bits/tape.hpp"
#include "tests/bits/target/meter.hpp"

namespace liana::bits {
namespace {

constexpr std::size_t kFileBuffer = 1 << 16;

template <class Arm>
std::string default_table() {
  std::string bytes;
  recording::append_serialised(bytes, typename Arm::Table{});
  return bytes;
}

// Reads all of `bytes`; false at the end of the file.
bool read_all(std::FILE* file, std::string& bytes) {
  return std::fread(bytes.data(), 1, bytes.size(), file) == bytes.size();
}

// Plays a tape of one kind of arm; false when it makes no sense or the disk refuses.
template <class Arm>
class Player {
 public:
  Player(std::FILE* tape, std::FILE* outputs) : tape_(tape), out_(outputs) {}

  bool play() {
    for (int mark = std::fgetc(tape_); mark != EOF; mark = std::fgetc(tape_)) {
      if (!take(static_cast<Mark>(mark))) return false;
    }
    return true;
  }

 private:
  bool take(Mark mark) {
    if (mark == kRobotMark<Arm>) return robot();
    if (!controller_) return false;
    if (mark == Mark::kTick) return tick();
    if (mark == Mark::kKeep) kept_ = controller_;
    if (mark == Mark::kReturn) controller_ = kept_;
    return mark == Mark::kKeep || mark == Mark::kReturn;
  }
  bool robot() {
    if (!read_all(tape_, table_)) return false;
    controller_.emplace(recording::table_from<Arm>(table_));
    return true;
  }
  bool tick() {
    if (!read_all(tape_, inputs_)) return false;
    written_.clear();
    recording::append_serialised(written_,
                                 metered_tick(*controller_, recording::RecordingDecoder::inputs<Arm>(inputs_)));
    return std::fwrite(written_.data(), 1, written_.size(), out_) == written_.size();
  }

  std::FILE* tape_;
  std::FILE* out_;
  std::string table_ = default_table<Arm>();
  std::string inputs_ = std::string(recording::serialised_inputs_size<Arm>(), '\0');
  std::string written_;
  std::optional<Controller<Arm>> controller_, kept_;
};

// The arm is the one whose table the tape begins with.
bool play(std::FILE* tape, std::FILE* outputs) {
  const int first = std::fgetc(tape);
  if (std::ungetc(first, tape) == EOF) return false;
  if (static_cast<Mark>(first) == Mark::kSerialRobot) return Player<serial::SerialArm>(tape, outputs).play();
  return Player<cable::CableArm>(tape, outputs).play();
}

int run() {
  std::FILE* const tape = std::fopen(kTapeFile, "rb");
  std::FILE* const outputs = std::fopen(kOutputsFile, "wb");
  if (tape == nullptr || outputs == nullptr) {
    std::fprintf(stderr, "bits_ticks: cannot open %s and %s in the working directory\n", kTapeFile, kOutputsFile);
    return 1;
  }
  std::setvbuf(tape, nullptr, _IOFBF, kFileBuffer);
  std::setvbuf(outputs, nullptr, _IOFBF, kFileBuffer);
  const bool played = play(tape, outputs);
  if (!played) std::fprintf(stderr, "bits_ticks: %s is no tape, or ends early, or the disk is full\n", kTapeFile);
  const bool closed = std::fclose(outputs) == 0 && std::fclose(tape) == 0;
  return played && closed && close_meter() ? 0 : 1;
}

}  // namespace
}  // namespace liana::bits

int main() { std::exit(liana::bits::run()); }  // bare metal has nowhere to return to
