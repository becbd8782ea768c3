// The SDO client against scripted answers.
#include "host/drives/canopen/sdo_client.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace liana::canopen {
namespace {

constexpr std::uint8_t kNode = 5;
constexpr std::uint32_t kTimeoutTicks = 4;

bus::CanFrame response(std::initializer_list<int> bytes) {
  bus::CanFrame frame;
  frame.id = 0x580 + kNode;
  frame.length = 8;
  std::size_t at = 0;
  for (const int byte : bytes) frame.data[at++] = static_cast<std::uint8_t>(byte);
  return frame;
}

// The request that is waiting; its data.
std::vector<int> request_of(SdoClient& client) {
  bus::CanFrame frame;
  if (!client.take_request(frame)) return {};
  EXPECT_EQ(frame.id, 0x600U + kNode);
  EXPECT_EQ(frame.length, 8);
  return {frame.data.begin(), frame.data.end()};
}

TEST(SdoClient, ReadsExpeditedValuesOfOneToFourBytes) {
  const int commands[] = {0x4F, 0x4B, 0x47, 0x43};
  const std::uint32_t values[] = {0x11, 0x2211, 0x332211, 0x44332211};
  for (int bytes = 1; bytes <= 4; ++bytes) {
    SdoClient client(kNode, kTimeoutTicks);
    client.start_upload(0x1018, 2);
    EXPECT_EQ(request_of(client), (std::vector<int>{0x40, 0x18, 0x10, 2, 0, 0, 0, 0}));
    client.on_response(response({commands[bytes - 1], 0x18, 0x10, 2, 0x11, 0x22, 0x33, 0x44}));
    EXPECT_EQ(client.status(), SdoStatus::kDone);
    EXPECT_EQ(client.data().size(), static_cast<std::size_t>(bytes));
    EXPECT_EQ(client.value(), values[bytes - 1]);
  }
}

TEST(SdoClient, AnAnswerOfAnotherLengthIsNoAnswerAndItsLengthIsKept) {
  SdoClient client(kNode, kTimeoutTicks);
  client.start_upload(0x1018, 2);
  request_of(client);
  bus::CanFrame brief = response({0x43, 0x18, 0x10, 2, 0x11, 0x22, 0x33});
  brief.length = 7;
  bus::CanFrame of_another = response({0x43, 0x18, 0x10, 3, 0x11});
  of_another.length = 5;
  client.on_response(of_another);
  EXPECT_EQ(client.odd_length(), std::nullopt) << "another tool's";
  client.on_response(brief);
  EXPECT_EQ(client.status(), SdoStatus::kBusy);
  EXPECT_EQ(client.odd_length(), std::uint8_t{7});
  for (std::uint32_t tick = 0; tick < kTimeoutTicks; ++tick) client.tick();
  EXPECT_EQ(client.status(), SdoStatus::kTimeout);
  EXPECT_EQ(client.odd_length(), std::uint8_t{7});
  client.start_upload(0x1018, 2);
  EXPECT_EQ(client.odd_length(), std::nullopt);
}

TEST(SdoClient, KnowsHowManyBytesAnObjectHasOnlyWhereTheServerSaysIt) {
  for (const auto& [command, bytes] : {std::pair{0x4F, 1U}, std::pair{0x43, 4U}, std::pair{0x42, 0U}}) {
    SdoClient client(kNode, kTimeoutTicks);
    client.start_upload(0x6061, 0);
    request_of(client);
    client.on_response(response({command, 0x61, 0x60, 0, 8}));
    EXPECT_EQ(client.status(), SdoStatus::kDone);
    EXPECT_EQ(client.said_bytes(), bytes);
  }
}

TEST(SdoClient, WritesExpeditedValuesOfOneToFourBytes) {
  const int commands[] = {0x2F, 0x2B, 0x27, 0x23};
  const std::uint8_t bytes[] = {1, 2, 3, 4};
  for (std::size_t count = 1; count <= 4; ++count) {
    SdoClient client(kNode, kTimeoutTicks);
    client.start_download(0x6065, 0, {bytes, count});
    std::vector<int> expected{commands[count - 1], 0x65, 0x60, 0, 0, 0, 0, 0};
    std::copy_n(bytes, count, expected.begin() + 4);
    EXPECT_EQ(request_of(client), expected);
    client.on_response(response({0x60, 0x65, 0x60, 0}));
    EXPECT_EQ(client.status(), SdoStatus::kDone);
  }
}

TEST(SdoClient, ReadsASegmentedString) {
  SdoClient client(kNode, kTimeoutTicks);
  client.start_upload(0x1008, 0);
  request_of(client);
  client.on_response(response({0x41, 0x08, 0x10, 0, 10, 0, 0, 0}));
  EXPECT_EQ(request_of(client), (std::vector<int>{0x60, 0, 0, 0, 0, 0, 0, 0}));
  client.on_response(response({0x00, 'a', 'b', 'c', 'd', 'e', 'f', 'g'}));
  EXPECT_EQ(request_of(client), (std::vector<int>{0x70, 0, 0, 0, 0, 0, 0, 0}));
  client.on_response(response({0x10 | (4 << 1) | 1, 'h', 'i', 'j'}));
  EXPECT_EQ(client.status(), SdoStatus::kDone);
  EXPECT_EQ(std::string(client.data().begin(), client.data().end()), "abcdefghij");
}

TEST(SdoClient, WritesSegmentsOfSevenBytesAndMarksTheLast) {
  std::vector<std::uint8_t> bytes(16);
  std::iota(bytes.begin(), bytes.end(), std::uint8_t{1});
  SdoClient client(kNode, kTimeoutTicks);
  client.start_download(0x2000, 1, bytes);
  EXPECT_EQ(request_of(client), (std::vector<int>{0x21, 0x00, 0x20, 1, 16, 0, 0, 0}));
  client.on_response(response({0x60, 0x00, 0x20, 1}));
  EXPECT_EQ(request_of(client), (std::vector<int>{0x00, 1, 2, 3, 4, 5, 6, 7}));
  client.on_response(response({0x20}));
  EXPECT_EQ(request_of(client), (std::vector<int>{0x10, 8, 9, 10, 11, 12, 13, 14}));
  client.on_response(response({0x30}));
  EXPECT_EQ(request_of(client), (std::vector<int>{0x00 | (5 << 1) | 1, 15, 16, 0, 0, 0, 0, 0}));
  EXPECT_EQ(client.status(), SdoStatus::kBusy);
  client.on_response(response({0x20}));
  EXPECT_EQ(client.status(), SdoStatus::kDone);
}

TEST(SdoClient, ReportsTheAbortCodeOfTheServer) {
  SdoClient client(kNode, kTimeoutTicks);
  client.start_upload(0x9999, 0);
  request_of(client);
  client.on_response(response({0x80, 0x99, 0x99, 0, 0x00, 0x00, 0x02, 0x06}));
  EXPECT_EQ(client.status(), SdoStatus::kAborted);
  EXPECT_EQ(client.abort_code(), kAbortNoObject);
  EXPECT_STREQ(abort_text(client.abort_code()), "object does not exist");
  EXPECT_STREQ(abort_text(0x12345678), "unknown abort code");
}

void pass(SdoClient& client, std::uint32_t ticks) {
  for (std::uint32_t i = 0; i < ticks; ++i) client.tick();
}

TEST(SdoClient, GivesUpAfterItsTicksAndTellsTheServer) {
  SdoClient client(kNode, kTimeoutTicks);
  client.start_upload(0x1000, 0);
  request_of(client);
  pass(client, kTimeoutTicks - 1);
  EXPECT_EQ(client.status(), SdoStatus::kBusy);
  client.tick();
  EXPECT_EQ(client.status(), SdoStatus::kTimeout);
  client.start_upload(0x1000, 0);
  EXPECT_EQ(request_of(client), (std::vector<int>{0x80, 0x00, 0x10, 0, 0x00, 0x00, 0x04, 0x05}))
      << "the abort goes out even when the next transfer begins at once";
  EXPECT_EQ(request_of(client)[0], 0x40);
  EXPECT_TRUE(request_of(client).empty());
}

TEST(SdoClient, ARequestThatTheBusNeverTakesTimesOutToo) {
  SdoClient client(kNode, kTimeoutTicks);
  client.start_upload(0x1000, 0);
  pass(client, kTimeoutTicks);
  EXPECT_EQ(client.status(), SdoStatus::kTimeout);
  EXPECT_TRUE(request_of(client).empty()) << "the server knows nothing of it: there is nothing to abort";
}

TEST(SdoClient, NoStrayKeepsATransferAliveBeyondItsTime) {
  const std::initializer_list<int> strays[] = {
      {0x43, 0x01, 0x10, 0, 1, 2, 3, 4},          // an answer to a read of another object
      {0x80, 0x01, 0x10, 0, 0, 0, 2, 6},          // another object's abort
      {0x60, 0x00, 0x10, 0},                      // a write of this object by somebody else
      {0x00, 'a', 'b', 'c', 'd', 'e', 'f', 'g'},  // segments of another tool's transfer, both ways
      {0x10, 0x00, 0x10, 0, 'd', 'e', 'f', 'g'},
      {0x20, 0x00, 0x10, 0},
      {0xC1, 0x00, 0x10, 0, 9, 9, 9, 9},  // block transfer
  };
  for (const auto& stray : strays) {
    SdoClient client(kNode, kTimeoutTicks);
    client.start_upload(0x1000, 0);
    request_of(client);
    for (std::uint32_t i = 1; i < kTimeoutTicks; ++i) {
      client.on_response(response(stray));
      client.tick();
      ASSERT_EQ(client.status(), SdoStatus::kBusy) << "of command byte " << *stray.begin();
    }
    client.on_response(response(stray));
    client.tick();
    EXPECT_EQ(client.status(), SdoStatus::kTimeout) << "of command byte " << *stray.begin();
  }
}

TEST(SdoClient, ASecondAnswerToAWriteIsNotTakenForThatOfItsReadBack) {
  const std::uint8_t value[] = {7};
  for (const int late : {0x60, 0x80}) {
    SdoClient client(kNode, kTimeoutTicks);
    client.start_download(0x6060, 0, value);
    request_of(client);
    pass(client, kTimeoutTicks);
    client.start_download(0x6060, 0, value);
    request_of(client);                                   // the abort
    request_of(client);                                   // the write again
    client.on_response(response({0x60, 0x60, 0x60, 0}));  // the first one's answer
    ASSERT_EQ(client.status(), SdoStatus::kDone);
    client.start_upload(0x6060, 0);
    request_of(client);
    client.on_response(response({late, 0x60, 0x60, 0, 0x22, 0, 0, 0x08}));  // the second one's
    EXPECT_EQ(client.status(), SdoStatus::kBusy) << "of command byte " << late;
    client.on_response(response({0x4F, 0x60, 0x60, 0, 7}));
    EXPECT_EQ(client.status(), SdoStatus::kDone);
    EXPECT_EQ(client.value(), 7U);
  }
}

TEST(SdoClient, AnAbortIsTakenForALateOneOnlyAsOftenAsOneIsOwed) {
  const std::uint8_t value[] = {7};
  SdoClient client(kNode, kTimeoutTicks);
  client.start_download(0x6060, 0, value);
  request_of(client);
  pass(client, kTimeoutTicks);
  request_of(client);  // the abort
  client.start_upload(0x6060, 0);
  request_of(client);
  client.on_response(response({0x80, 0x60, 0x60, 0, 0x01, 0x00, 0x01, 0x06}));
  EXPECT_EQ(client.status(), SdoStatus::kBusy) << "the answer to the write that was given up";
  client.on_response(response({0x80, 0x60, 0x60, 0, 0x01, 0x00, 0x01, 0x06}));
  EXPECT_EQ(client.status(), SdoStatus::kAborted);
}

TEST(SdoClient, SegmentsWithoutDataDoNotGoOnForEver) {
  SdoClient client(kNode, kTimeoutTicks);
  client.start_upload(0x1008, 0);
  request_of(client);
  client.on_response(response({0x40, 0x08, 0x10, 0}));
  request_of(client);
  client.on_response(response({7 << 1}));
  EXPECT_EQ(client.status(), SdoStatus::kAborted);
  EXPECT_EQ(client.abort_code(), kAbortCommand);
}

TEST(SdoClient, AbortsWhenTheToggleBitDoesNotAlternate) {
  SdoClient client(kNode, kTimeoutTicks);
  client.start_upload(0x1008, 0);
  request_of(client);
  client.on_response(response({0x41, 0x08, 0x10, 0, 20, 0, 0, 0}));
  request_of(client);
  client.on_response(response({0x10, 'a', 'b', 'c', 'd', 'e', 'f', 'g'}));
  EXPECT_EQ(client.status(), SdoStatus::kAborted);
  EXPECT_EQ(client.abort_code(), kAbortToggle);
  EXPECT_EQ(request_of(client)[0], 0x80);
}

TEST(SdoClient, RefusesObjectsLongerThanItsBufferBothWays) {
  SdoClient client(kNode, kTimeoutTicks);
  client.start_upload(0x1008, 0);
  request_of(client);
  client.on_response(response({0x41, 0x08, 0x10, 0, 65, 0, 0, 0}));
  EXPECT_EQ(client.abort_code(), kAbortMemory);
  client.start_upload(0x1008, 0);
  EXPECT_EQ(request_of(client)[0], 0x80);
  request_of(client);
  client.on_response(response({0x40, 0x08, 0x10, 0}));  // size not announced
  for (int i = 0; i < 10; ++i) {
    request_of(client);
    client.on_response(response({i % 2 == 0 ? 0x00 : 0x10, 1, 2, 3, 4, 5, 6, 7}));
  }
  EXPECT_EQ(client.status(), SdoStatus::kAborted);
  EXPECT_EQ(client.abort_code(), kAbortMemory);
  const std::vector<std::uint8_t> long_object(65);
  client.start_download(0x2000, 0, long_object);
  EXPECT_EQ(client.status(), SdoStatus::kAborted);
}

TEST(SdoClient, IgnoresAnswersToAnotherObjectAndAnswersNobodyAskedFor) {
  SdoClient client(kNode, kTimeoutTicks);
  client.on_response(response({0x43, 0x00, 0x10, 0, 1, 2, 3, 4}));
  EXPECT_EQ(client.status(), SdoStatus::kIdle);
  client.start_upload(0x1000, 0);
  request_of(client);
  client.on_response(response({0x43, 0x01, 0x10, 0, 1, 2, 3, 4}));
  client.on_response(response({0x80, 0x01, 0x10, 0, 0, 0, 2, 6}));
  EXPECT_EQ(client.status(), SdoStatus::kBusy);
  client.on_response(response({0x43, 0x00, 0x10, 0, 1, 2, 3, 4}));
  EXPECT_EQ(client.value(), 0x04030201U);
}

// A client whose segmented read of 10 bytes has just failed, in its second segment.
SdoClient after_a_failed_read() {
  SdoClient client(kNode, kTimeoutTicks);
  client.start_upload(0x1008, 0);
  request_of(client);
  client.on_response(response({0x41, 0x08, 0x10, 0, 10, 0, 0, 0}));
  request_of(client);
  client.on_response(response({0x00, 'a', 'b', 'c', 'd', 'e', 'f', 'g'}));
  request_of(client);
  client.on_response(response({0x00, 'h'}));
  EXPECT_EQ(client.abort_code(), kAbortToggle);
  EXPECT_EQ(request_of(client)[0], 0x80);
  return client;
}

TEST(SdoClient, AReadKnowsNothingOfTheTransferBefore) {
  SdoClient client = after_a_failed_read();
  client.start_upload(0x1008, 0);
  EXPECT_EQ(request_of(client)[0], 0x40);
  client.on_response(response({0x40, 0x08, 0x10, 0}));
  EXPECT_EQ(request_of(client)[0], 0x60);
  client.on_response(response({(4 << 1) | 1, 'x', 'y', 'z'}));
  EXPECT_EQ(client.status(), SdoStatus::kDone);
  EXPECT_EQ(client.abort_code(), 0U);
  EXPECT_EQ(client.said_bytes(), 0U);
  EXPECT_EQ(std::string(client.data().begin(), client.data().end()), "xyz");
}

TEST(SdoClient, AWriteKnowsNothingOfTheTransferBefore) {
  SdoClient client = after_a_failed_read();
  const std::vector<std::uint8_t> bytes{1, 2, 3, 4, 5, 6, 7, 8, 9};
  for (int round = 0; round < 2; ++round) {
    client.start_download(0x2000, 1, bytes);
    EXPECT_EQ(request_of(client), (std::vector<int>{0x21, 0x00, 0x20, 1, 9, 0, 0, 0}));
    client.on_response(response({0x60, 0x00, 0x20, 1}));
    EXPECT_EQ(request_of(client), (std::vector<int>{0x00, 1, 2, 3, 4, 5, 6, 7}));
    client.on_response(response({0x20}));
    EXPECT_EQ(request_of(client), (std::vector<int>{0x10 | (5 << 1) | 1, 8, 9, 0, 0, 0, 0, 0}));
    EXPECT_EQ(client.status(), SdoStatus::kBusy);
    client.on_response(response({0x30}));
    EXPECT_EQ(client.status(), SdoStatus::kDone);
  }
}

TEST(SdoClient, AnEmptyWriteIsRefusedAndLeavesNoRequest) {
  SdoClient client(kNode, kTimeoutTicks);
  client.start_upload(0x2000, 1);
  client.start_download(0x2000, 1, {});
  EXPECT_EQ(client.status(), SdoStatus::kAborted);
  EXPECT_EQ(client.abort_code(), kAbortMemory);
  EXPECT_TRUE(request_of(client).empty());
}

TEST(SdoClient, FiveBytesAreOneMoreThanARequestHolds) {
  SdoClient client(kNode, kTimeoutTicks);
  client.start_download(0x2000, 1, std::vector<std::uint8_t>{1, 2, 3, 4, 5});
  EXPECT_EQ(request_of(client), (std::vector<int>{0x21, 0x00, 0x20, 1, 5, 0, 0, 0}));
  client.on_response(response({0x60, 0x00, 0x20, 1}));
  EXPECT_EQ(request_of(client), (std::vector<int>{(2 << 1) | 1, 1, 2, 3, 4, 5, 0, 0}));
}

TEST(SdoClient, ItsBufferMayBeFull) {
  const std::vector<std::uint8_t> bytes(kSdoBufferBytes, 7);
  SdoClient client(kNode, kTimeoutTicks);
  client.start_download(0x2000, 1, bytes);
  EXPECT_EQ(client.status(), SdoStatus::kBusy);
  for (const bool sized : {true, false}) {
    client.start_upload(0x2000, 1);
    request_of(client);
    client.on_response(response({sized ? 0x41 : 0x40, 0x00, 0x20, 1, kSdoBufferBytes & 0xFF, kSdoBufferBytes >> 8}));
    std::size_t read = 0;
    for (int toggle = 0; read < kSdoBufferBytes; toggle ^= 0x10) {
      ASSERT_EQ(request_of(client)[0], 0x60 | toggle);
      const int count = static_cast<int>(std::min<std::size_t>(7, kSdoBufferBytes - read));
      read += static_cast<std::size_t>(count);
      client.on_response(
          response({toggle | (7 - count) << 1 | (read == kSdoBufferBytes ? 1 : 0), 7, 7, 7, 7, 7, 7, 7}));
    }
    EXPECT_EQ(client.status(), SdoStatus::kDone);
    EXPECT_EQ(client.data().size(), kSdoBufferBytes);
  }
}

TEST(SdoClient, AReadEndsWithAnEmptySegmentButNotWithAnotherLengthThanWasSaid) {
  for (const int said : {0, 7, 8}) {
    SdoClient client(kNode, kTimeoutTicks);
    client.start_upload(0x1008, 0);
    request_of(client);
    client.on_response(response({said == 0 ? 0x40 : 0x41, 0x08, 0x10, 0, said}));
    request_of(client);
    client.on_response(response({0x00, 1, 2, 3, 4, 5, 6, 7}));
    request_of(client);
    client.on_response(response({0x10 | (7 << 1) | 1}));
    EXPECT_EQ(client.status(), said == 8 ? SdoStatus::kAborted : SdoStatus::kDone) << said;
    EXPECT_EQ(client.abort_code(), said == 8 ? kAbortGeneral : 0U) << said;
  }
}

TEST(SdoClient, AnAnswerIsOneOnlyAfterItsRequestAndUntilThereWasOne) {
  SdoClient client(kNode, kTimeoutTicks);
  client.start_upload(0x1018, 2);
  const bus::CanFrame answer = response({0x43, 0x18, 0x10, 2, 1});
  client.on_response(answer);
  EXPECT_EQ(client.status(), SdoStatus::kBusy) << "the bus has not taken the request";
  request_of(client);
  client.on_response(answer);
  client.on_response(response({0x43, 0x18, 0x10, 2, 9}));
  EXPECT_EQ(client.value(), 1U);
}

TEST(SdoClient, AnAbortAmongSegmentsIsThatOfItsObject) {
  SdoClient client(kNode, kTimeoutTicks);
  client.start_upload(0x1008, 0);
  request_of(client);
  client.on_response(response({0x40, 0x08, 0x10, 0}));
  request_of(client);
  client.on_response(response({0x80, 0x08, 0x10, 1, 0, 0, 2, 6}));
  EXPECT_EQ(client.status(), SdoStatus::kBusy) << "another tool's";
  client.on_response(response({0x80, 0x08, 0x10, 0, 0, 0, 2, 6}));
  EXPECT_EQ(client.status(), SdoStatus::kAborted);
}

TEST(SdoClient, ALateAnswerIsOwedByItsOwnObjectOnly) {
  for (const auto& [index, sub] : {std::pair{0x2001, 1}, std::pair{0x2000, 2}}) {
    SdoClient client(kNode, kTimeoutTicks);
    client.start_download(0x2000, 1, std::vector<std::uint8_t>{1});
    request_of(client);
    pass(client, kTimeoutTicks);
    request_of(client);
    client.start_upload(static_cast<std::uint16_t>(index), static_cast<std::uint8_t>(sub));
    request_of(client);
    client.on_response(response({0x80, index & 0xFF, 0x20, sub, 0, 0, 2, 6}));
    EXPECT_EQ(client.status(), SdoStatus::kAborted) << index << " " << sub;
  }
}

TEST(SdoClient, ABriefFrameIsKeptWhenItNamesNoObjectOrThisOne) {
  for (const auto& [length, sub, kept] : {std::tuple{3, 3, true}, std::tuple{4, 3, false}, std::tuple{4, 2, true}}) {
    SdoClient client(kNode, kTimeoutTicks);
    client.start_upload(0x1018, 2);
    request_of(client);
    bus::CanFrame brief = response({0x43, 0x18, 0x10, sub});
    brief.length = static_cast<std::uint8_t>(length);
    client.on_response(brief);
    EXPECT_EQ(client.odd_length().has_value(), kept) << length << " " << sub;
  }
}

}  // namespace
}  // namespace liana::canopen
