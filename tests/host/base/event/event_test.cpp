// One event: names of kinds, and its line in a file.
#include "host/base/event/event.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

namespace liana::event {
namespace {

TEST(Event, EveryKindHasANameOfItsOwnThatLeadsBackToIt) {
  std::set<std::string> names;
  for (std::size_t k = 0; k < kEventKinds; ++k) {
    const auto kind = static_cast<EventKind>(k);
    names.insert(event_kind_name(kind));
    EXPECT_EQ(event_kind_from(event_kind_name(kind)), kind);
  }
  EXPECT_EQ(names.size(), kEventKinds);
  EXPECT_EQ(event_kind_from("weather"), std::nullopt);
  EXPECT_EQ(event_kind_from(""), std::nullopt);
}

TEST(Event, ErrorCodesOfTheApiHaveNumbers) {
  EXPECT_EQ(refusal_event("bad_request"), RefusalEvent::kBadRequest);
  EXPECT_EQ(refusal_event("no_device"), RefusalEvent::kNoDevice);
  EXPECT_EQ(refusal_event("weather"), RefusalEvent::kOther);
  EXPECT_EQ(refusal_event(""), RefusalEvent::kOther);
}

TEST(Event, ALineHasAColumnForEachOfTheHeading) {
  const Event event{.kind = EventKind::kVerdict,
                    .number = 104,
                    .subject = "execution",
                    .values = {{"command", 17.0}, {"share", 1.25}},
                    .text = "cable 7",
                    .sequence = 12,
                    .tick = 1234};
  EXPECT_EQ(event_line(event, 0.004),
            "      12\t   4.936\t    1234\tverdict     \t   104\texecution\tcable 7\t"
            "command=17 share=1.25");
  const std::string heading = kEventLineHeading, line = event_line(event, 0.004);
  EXPECT_EQ(std::count(heading.begin(), heading.end(), '\t'), std::count(line.begin(), line.end(), '\t'));
}

TEST(Event, NoTextBreaksItsLineOrItsColumns) {
  Event event;
  event.subject = "a\tb\nc";
  event.text = "d\r\x7F\x1b[1m \xC3\xA4";
  const std::string line = event_line(event, 0.004);
  EXPECT_EQ(std::count(line.begin(), line.end(), '\t'), 7);
  EXPECT_NE(line.find("a b c\td   [1m \xC3\xA4\t"), std::string::npos) << line;
  EXPECT_TRUE(std::none_of(line.begin(), line.end(), [](char c) { return c == '\n' || c == '\x1b' || c == '\r'; }));
}

}  // namespace
}  // namespace liana::event
