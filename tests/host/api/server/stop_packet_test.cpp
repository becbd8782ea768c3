// A stop is recognised however badly it is written, and nothing else is taken for one.
#include "host/api/server/stop_packet.hpp"

#include <gtest/gtest.h>

namespace liana::api {
namespace {

TEST(StopPacket, IsRecognisedInWhatIsNoJson) {
  const std::string deep(100000, '[');
  for (const std::string& packet :
       {std::string(R"({"op":"stop")"), std::string(R"( { "reason" : "x", "op" : "stop" ,})"),
        std::string("{\"op\":\"stop\",\"reason\":\"\xff\xfe\"}"), R"({"op":"stop","reason":)" + deep,
        std::string(R"({"reason":{"a":["]",{"b":"}"}]},"op":"stop"})"),
        std::string(R"({"reason":"a \" quote","op":"stop"})"), std::string(R"({"op":"stop","reason":"never ends)")}) {
    EXPECT_TRUE(read_stop(packet).is_stop) << packet.substr(0, 60);
  }
}

TEST(StopPacket, IsNotSeenInOtherRequests) {
  for (const std::string packet :
       {"", "{", "{}", "stop", R"("op":"stop")", R"({"op":"stops"})", R"({"op":"move","then":{"op":"stop"}})",
        R"({"op":"tool","command":"\"op\":\"stop\""})", R"({"x":["op","stop"]})", R"([{"op":"stop"}])"}) {
    EXPECT_FALSE(read_stop(packet).is_stop) << packet;
  }
}

TEST(StopPacket, KeepsTheReasonAsItWasWritten) {
  EXPECT_EQ(read_stop(R"({"op":"stop","reason":"too close",})").reason, "too close");
  EXPECT_EQ(read_stop(R"({"op":"stop","reason":[1,2],})").reason, "[1,2]");
  EXPECT_EQ(read_stop(R"({"op":"stop",})").reason, "");
  EXPECT_EQ(read_stop(R"({"op":"stop","reason":")" + std::string(5000, 'x')).reason.size(), 1000u);
}

}  // namespace
}  // namespace liana::api
