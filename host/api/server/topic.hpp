// What a client can subscribe to.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace liana::api {

enum class Topic : std::uint8_t { kState, kCamera, kTick, kEvent, kTool };
// As in hello, in the order of Topic.
constexpr std::array<const char*, 5> kTopicNames{"state", "camera", "tick", "event", "tool"};

constexpr std::size_t index_of(Topic topic) { return static_cast<std::size_t>(topic); }

}  // namespace liana::api
