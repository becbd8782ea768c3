// Many packets with one call, at both ends.
#include <gtest/gtest.h>
#include <sys/socket.h>

#include <array>
#include <string>
#include <vector>

#include "host/base/net/socket.hpp"

namespace liana::api {
namespace {

struct Ends {
  Ends() {
    std::array<int, 2> both{};
    EXPECT_EQ(::socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, both.data()), 0);
    ours = UniqueFd(both[0]);
    theirs = UniqueFd(both[1]);
  }
  UniqueFd ours, theirs;
};

std::vector<std::string> numbered(std::size_t count) {
  std::vector<std::string> packets;
  for (std::size_t i = 0; i < count; ++i) packets.push_back("packet " + std::to_string(i));
  return packets;
}

// All that `reader` has now, and how it ended.
struct Heard {
  Heard(PacketReader& reader, const UniqueFd& fd) {
    std::string_view packet;
    while ((end = reader.next(fd.get(), packet)) == SocketResult::kDone) packets.emplace_back(packet);
  }
  std::vector<std::string> packets;
  SocketResult end = SocketResult::kDone;
};

std::size_t sent(const UniqueFd& fd, const std::vector<std::string>& packets) {
  const std::vector<std::string_view> views(packets.begin(), packets.end());
  std::span<const std::string_view> left(views);
  send_packets(fd.get(), left);
  return packets.size() - left.size();
}

// The numbers about what one call takes, 32.
TEST(Packets, ComeWholeAndInTheirOrderHoweverManyThereAre) {
  for (const std::size_t count : {0u, 1u, 31u, 32u, 33u, 64u, 100u}) {
    Ends ends;
    PacketReader reader(100);
    EXPECT_EQ(sent(ends.ours, numbered(count)), count);
    const Heard heard(reader, ends.theirs);
    EXPECT_EQ(heard.packets, numbered(count));
    EXPECT_EQ(heard.end, SocketResult::kWouldBlock) << count;
  }
}

TEST(Packets, OfAPeerThatHasLeftAreReadBeforeItsEnd) {
  for (const std::size_t count : {0u, 1u, 31u, 32u, 33u}) {
    Ends ends;
    PacketReader reader(100);
    EXPECT_EQ(sent(ends.ours, numbered(count)), count);
    ends.ours = UniqueFd();
    const Heard heard(reader, ends.theirs);
    EXPECT_EQ(heard.packets.size(), count);
    EXPECT_EQ(heard.end, SocketResult::kClosed) << count;
    EXPECT_EQ(Heard(reader, ends.theirs).end, SocketResult::kClosed) << count << ", asked again";
  }
}

TEST(Packets, ThatAreTooLongComeCutToOneByteTooMany) {
  Ends ends;
  PacketReader reader(4);
  EXPECT_EQ(sent(ends.ours, {"1234", "12345", "123456789"}), 3u);
  EXPECT_EQ(Heard(reader, ends.theirs).packets, (std::vector<std::string>{"1234", "12345", "12345"}));
}

TEST(Packets, ThatFindNoRoomAreLeftOver) {
  Ends ends;
  const std::vector<std::string> many(100'000, std::string(1000, 'x'));
  const std::size_t first = sent(ends.ours, many);
  EXPECT_GT(first, 0u);
  EXPECT_LT(first, many.size());
  EXPECT_EQ(sent(ends.ours, many), 0u);
  PacketReader reader(1000);
  EXPECT_EQ(Heard(reader, ends.theirs).packets.size(), first);
  EXPECT_EQ(sent(ends.ours, many), first);
}

TEST(Packets, ToAPeerThatHasLeftSayThatItIsGone) {
  Ends ends;
  ends.theirs = UniqueFd();
  const std::string_view packet = "x";
  std::span<const std::string_view> left(&packet, 1);
  EXPECT_EQ(send_packets(ends.ours.get(), left), SocketResult::kClosed);
  EXPECT_EQ(left.size(), 1u);
}

}  // namespace
}  // namespace liana::api
