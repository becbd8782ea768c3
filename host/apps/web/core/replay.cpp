// The core in a browser: recorded Inputs go in, Outputs come out in recorded form, and the page compares them. Bytes
// pass through one place, which the page sizes. What makes no sense traps, and the page says so.
#include <cstdint>
#include <optional>
#include <string>
#include <type_traits>
#include <variant>

#include "host/storage/recording/replay_core.hpp"

namespace liana::recording {
namespace {

std::string place;
std::variant<std::monostate, ReplayCore<cable::CableArm>, ReplayCore<serial::SerialArm>> core;

template <class Arm>
void start_as() {
  core.emplace<ReplayCore<Arm>>(parse_image<Arm>(place, "this page"), "this page");
}

}  // namespace
}  // namespace liana::recording

using namespace liana::recording;

extern "C" {

// Where `bytes` bytes may be written, until the next call of any function here.
[[clang::export_name("room")]] char* room(std::uint32_t bytes) {
  place.resize(bytes);
  return place.data();
}

// Starts from the recording's start message, which is in the room.
[[clang::export_name("start")]] void start(bool is_serial) {
  is_serial ? start_as<liana::serial::SerialArm>() : start_as<liana::cable::CableArm>();
}

// One tick with the Inputs in the room, whose place then holds the Outputs: returns how many bytes they are. 0: these
// are not the Inputs of the next tick.
[[clang::export_name("tick")]] std::uint32_t tick() {
  std::visit(
      [](auto& running) {
        if constexpr (!std::is_same_v<std::decay_t<decltype(running)>, std::monostate>)
          place = running.is_next(place) ? running.tick(place) : std::string();
      },
      core);
  return static_cast<std::uint32_t>(place.size());
}

// Where the Outputs are.
[[clang::export_name("outputs")]] const char* outputs() { return place.data(); }
}
