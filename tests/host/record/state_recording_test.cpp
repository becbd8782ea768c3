// The JSON channels of a recording: every state, every event once, every verdict once.
#include "host/record/state_recording.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>

namespace liana {
namespace {

Json state_at(std::uint64_t tick, const std::vector<std::string>& events, std::uint64_t verdict) {
  Json list = Json::array();
  for (const std::string& text : events) list.push_back({{"tick", tick}, {"text", text}});
  return {{"op", "state"}, {"tick", tick}, {"events", list}, {"verdict", {{"sequence", verdict}, {"released", true}}}};
}

std::map<std::string, std::vector<Json>> recorded(const std::vector<Json>& states) {
  const std::string folder = testing::TempDir() + "liana_state_" + std::to_string(::getpid());
  std::filesystem::create_directories(folder);
  StateRecording recording(folder, 0.004);
  for (const Json& state : states) recording.take(state.dump(), state);
  recording.finish();
  std::map<std::string, std::vector<Json>> seen;
  McapVisitor visitor;
  visitor.message = [&](const std::string& topic, std::uint32_t, std::uint64_t time_ns, std::string_view data) {
    seen[topic].push_back(Json::parse(data));
    EXPECT_EQ(time_ns, seen[topic].back().at("tick").get<std::uint64_t>() * 4000000u);
  };
  EXPECT_EQ(read_mcap(folder + "/" + kStateFile, visitor), McapState::kWhole);
  return seen;
}

TEST(StateRecording, EveryStateIsThereAsItCame) {
  const std::vector<Json> states{state_at(5, {}, 0), state_at(10, {"a"}, 1)};
  EXPECT_EQ(recorded(states).at("state"), states);
}

TEST(StateRecording, AnEventOfTheSlidingListIsWrittenOnce) {
  const auto texts = [](const std::vector<std::vector<std::string>>& lists) {
    std::vector<Json> states;
    for (const std::vector<std::string>& list : lists) states.push_back(state_at(0, list, 0));
    std::string text;
    for (const Json& event : recorded(states)["event"]) text += event.at("text").get<std::string>();
    return text;
  };
  EXPECT_EQ(texts({{"a"}, {"a"}, {"a", "b"}, {"b", "c"}, {"c", "d", "e"}}), "abcde");
  EXPECT_EQ(texts({{"a", "a"}, {"a", "b"}}), "aab");
  EXPECT_EQ(texts({{"a", "b"}, {"x", "y"}}), "abxy");
}

TEST(StateRecording, AVerdictIsWrittenWhenItIsNew) {
  const auto seen = recorded({state_at(5, {}, 1), state_at(10, {}, 1), state_at(15, {}, 2)});
  ASSERT_EQ(seen.at("verdict").size(), 2u);
  EXPECT_EQ(seen.at("verdict")[1].at("tick").get<int>(), 15);
  EXPECT_EQ(seen.at("verdict")[1].at("sequence").get<int>(), 2);
}

}  // namespace
}  // namespace liana
