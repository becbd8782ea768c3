// The JSON channels of a recording: every state, every event, every verdict once.
#include "host/storage/recording/state_recording.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>

#include "host/base/event/event_json.hpp"

namespace liana::recording {
namespace {

Json state_at(std::uint64_t tick, std::uint64_t verdict) {
  return {{"op", "state"}, {"tick", tick}, {"verdict", {{"sequence", verdict}, {"released", true}}}};
}

Json event_at(std::uint64_t tick, std::uint64_t sequence) {
  return event::event_json({.kind = event::EventKind::kTool, .text = "tool: weld", .sequence = sequence, .tick = tick});
}

struct Recorded {
  std::map<std::string, std::vector<Json>> seen;  // by channel
  std::map<std::string, std::string> end;         // metadata
};

Recorded recorded(const std::vector<Json>& messages) {
  const std::string folder = testing::TempDir() + "liana_state_" + std::to_string(::getpid());
  std::filesystem::create_directories(folder);
  StateRecording recording(folder, 0.004);
  for (const Json& message : messages) {
    if (message["op"] == "state") recording.take(message.dump(), message);
    if (message["op"] != "state") recording.take_event(message.dump(), message);
  }
  recording.finish();
  Recorded found;
  McapVisitor visitor;
  visitor.message = [&](const std::string& topic, std::uint32_t, std::uint64_t time_ns, std::string_view data) {
    found.seen[topic].push_back(Json::parse(data));
    EXPECT_EQ(time_ns, found.seen[topic].back().at("tick").get<std::uint64_t>() * 4000000u);
  };
  visitor.metadata = [&](const std::string& name, const std::map<std::string, std::string>& values) {
    EXPECT_EQ(name, "end");
    found.end = values;
  };
  EXPECT_EQ(read_mcap(folder + "/" + kStateFile, visitor), McapState::kWhole);
  return found;
}

TEST(StateRecording, EveryStateAndEveryEventIsThereAsItCame) {
  const std::vector<Json> states{state_at(5, 0), state_at(10, 1)},
      events{event_at(5, 1), event_at(5, 2), event_at(9, 3)};
  const Recorded found = recorded({events[0], states[0], events[1], events[2], states[1]});
  EXPECT_EQ(found.seen.at("state"), states);
  EXPECT_EQ(found.seen.at("event"), events);
}

TEST(StateRecording, ItsEndSaysHowManyEventsThereAreAndHowManyAreMissing) {
  const Json lost{{"op", "events_lost"}, {"from", 1}, {"to", 7}, {"count", 7}};
  EXPECT_EQ(recorded({lost, event_at(5, 8)}).end,
            (std::map<std::string, std::string>{{"events", "1"}, {"events_lost", "7"}}));
}

TEST(StateRecording, AVerdictIsWrittenWhenItIsNew) {
  const auto seen = recorded({state_at(5, 1), state_at(10, 1), state_at(15, 2)}).seen;
  ASSERT_EQ(seen.at("verdict").size(), 2u);
  EXPECT_EQ(seen.at("verdict")[1].at("tick").get<int>(), 15);
  EXPECT_EQ(seen.at("verdict")[1].at("sequence").get<int>(), 2);
}

}  // namespace
}  // namespace liana::recording
