// Recorded hand motion: the reader of `.hand` files (docs/reference/formats.md).
#pragma once

#include <iosfwd>
#include <string>
#include <variant>
#include <vector>

#include "host/operator/simulated/samples.hpp"

namespace liana::simulated {

using VrRecording = std::vector<BothHands>;
using HandRecording = std::vector<device::Sample>;

// Reads a `.hand` file of either kind; at least one sample, times from 0 and strictly increasing, unit quaternions.
// Throws std::runtime_error naming file, line, column, value, what is allowed and what to do.
std::variant<VrRecording, HandRecording> read_hand_recording(const std::string& path);

// The same from a stream, which messages call `path`.
std::variant<VrRecording, HandRecording> parse_hand_recording(std::istream& stream, const std::string& path);

// The same for a file that must hold VR handles, or a hand controller.
VrRecording read_vr_recording(const std::string& path);
HandRecording read_hand_controller_recording(const std::string& path);

}  // namespace liana::simulated
