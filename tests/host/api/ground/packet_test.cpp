// Packets by the clauses of CCSDS 133.0-B-2, ECSS-E-ST-70-41C and CCSDS 301.0-B-4.
#include "host/api/ground/packet.hpp"

#include <gtest/gtest.h>

namespace liana::ground {
namespace {

std::string octets(std::initializer_list<unsigned> list) {
  std::string out;
  for (const unsigned each : list) out += static_cast<char>(each);
  return out;
}

Telecommand ping() {
  Telecommand out;
  out.primary.apid = 0x73;
  out.primary.count = 25;
  out.service = 17;
  out.subtype = 1;
  return out;
}

// The packet with octet `place` changed by `bits`, and its checksum made right again.
std::string changed(std::string packet, std::size_t place, unsigned bits) {
  packet[place] = static_cast<char>(static_cast<unsigned char>(packet[place]) ^ bits);
  packet.resize(packet.size() - kChecksumBytes);
  append_whole(packet, checksum(packet), kChecksumBytes);
  return packet;
}

Failure failure_of(const std::string& packet) {
  Telecommand out;
  return read_telecommand(packet, out);
}

// ECSS-E-ST-70-41C annex B.1.5: values that an implementation has to give.
TEST(Checksum, IsThatOfTheStandardsExamples) {
  EXPECT_EQ(checksum(octets({0x00, 0x00})), 0x1d0f);
  EXPECT_EQ(checksum(octets({0x00, 0x00, 0x00})), 0xcc9c);
  EXPECT_EQ(checksum(octets({0xab, 0xcd, 0xef, 0x01})), 0x04a2);
  EXPECT_EQ(checksum(octets({0x14, 0x56, 0xf8, 0x9a, 0x00, 0x01})), 0x7fd5);
  EXPECT_EQ(checksum("123456789"), 0x29b1);
}

// Clause 4.1.3: version 3 bits, type 1, secondary header flag 1, APID 11, sequence flags 2, count 14, length 16.
TEST(PrimaryHeader, HasEachFieldAtItsBits) {
  struct Row {
    PrimaryHeader header;
    std::string bytes;
  };
  const Row rows[] = {
      {{0, false, false, 0, 0, 0, 1}, octets({0, 0, 0, 0, 0, 0})},
      {{7, false, false, 0, 0, 0, 1}, octets({0xe0, 0, 0, 0, 0, 0})},
      {{0, true, false, 0, 0, 0, 1}, octets({0x10, 0, 0, 0, 0, 0})},
      {{0, false, true, 0, 0, 0, 1}, octets({0x08, 0, 0, 0, 0, 0})},
      {{0, false, false, 2047, 0, 0, 1}, octets({0x07, 0xff, 0, 0, 0, 0})},
      {{0, false, false, 0, 3, 0, 1}, octets({0, 0, 0xc0, 0, 0, 0})},
      {{0, false, false, 0, 0, 16383, 1}, octets({0, 0, 0x3f, 0xff, 0, 0})},
      {{0, false, false, 0, 0, 0, 65536}, octets({0, 0, 0, 0, 0xff, 0xff})},
      {{0, true, true, 100, 3, 1, 7}, octets({0x18, 0x64, 0xc0, 0x01, 0x00, 0x06})},
  };
  for (const Row& row : rows) {
    EXPECT_EQ(primary_bytes(row.header), row.bytes);
    EXPECT_EQ(read_primary(row.bytes), row.header);
  }
  EXPECT_FALSE(read_primary(octets({0x18, 0x64, 0xc0, 0x01, 0x00})));
}

TEST(Telecommand, OfTheConnectionTestHasTheOctetsOfTheStandard) {
  const std::string packet = telecommand_bytes(ping());
  EXPECT_EQ(packet.substr(0, 11), octets({0x18, 0x73, 0xc0, 0x19, 0x00, 0x06, 0x2f, 17, 1, 0, 0}));
  EXPECT_EQ(checksum(packet), 0);
}

TEST(Telecommand, ComesBackAsItWas) {
  for (const std::size_t size : {std::size_t{0}, std::size_t{1}, kMaxPacketBytes - 13}) {
    Telecommand sent = ping();
    sent.primary.apid = 2046;
    sent.primary.count = 16383;
    sent.acknowledge = 9;
    sent.source = 0xfffe;
    sent.data = std::string(size, '\xa5');
    Telecommand got;
    ASSERT_EQ(read_telecommand(telecommand_bytes(sent), got), Failure::kNone);
    EXPECT_EQ(got.primary.apid, 2046);
    EXPECT_EQ(got.primary.count, 16383);
    EXPECT_EQ(got.acknowledge, 9);
    EXPECT_EQ(got.service, 17);
    EXPECT_EQ(got.source, 0xfffe);
    EXPECT_EQ(got.data, sent.data);
  }
}

TEST(Telecommand, IsRefusedForWhatIsWrongOfIt) {
  const std::string good = telecommand_bytes(ping());
  EXPECT_EQ(failure_of(good), Failure::kNone);
  for (std::size_t size = 0; size < good.size(); ++size) EXPECT_EQ(failure_of(good.substr(0, size)), Failure::kLength);
  EXPECT_EQ(failure_of(good + '\0'), Failure::kLength);
  EXPECT_EQ(failure_of(changed(good, 0, 0x20)), Failure::kHeader);  // version 1
  EXPECT_EQ(failure_of(changed(good, 0, 0x10)), Failure::kHeader);  // telemetry
  EXPECT_EQ(failure_of(changed(good, 0, 0x08)), Failure::kHeader);  // without a secondary header
  EXPECT_EQ(failure_of(changed(good, 2, 0x40)), Failure::kHeader);  // a segment
  EXPECT_EQ(failure_of(changed(good, 6, 0x30)), Failure::kHeader);  // PUS-A
  for (std::size_t bit = 0; bit < 8 * good.size(); ++bit) {
    std::string bad = good;
    bad[bit / 8] = static_cast<char>(static_cast<unsigned char>(bad[bit / 8]) ^ (1u << bit % 8));
    EXPECT_NE(failure_of(bad), Failure::kNone) << bit;
  }
  Telecommand large = ping();
  large.data = std::string(kMaxPacketBytes - 12, '\0');
  EXPECT_EQ(failure_of(telecommand_bytes(large)), Failure::kLength);
}

TEST(Telemetry, ComesBackAsItWas) {
  Telemetry sent;
  sent.primary = {0, false, true, kArmApid, 3, 77, 1};
  sent.service = 3;
  sent.subtype = 25;
  sent.message_count = 0xffff;
  sent.destination = 0x1234;
  sent.time_us = 1780000000123456;
  sent.data = "data";
  const auto got = read_telemetry(telemetry_bytes(sent));
  ASSERT_TRUE(got);
  EXPECT_EQ(got->primary.count, 77);
  EXPECT_EQ(got->service, 3);
  EXPECT_EQ(got->subtype, 25);
  EXPECT_EQ(got->message_count, 0xffff);
  EXPECT_EQ(got->destination, 0x1234);
  EXPECT_EQ(got->time_us, sent.time_us);
  EXPECT_EQ(got->data, "data");
  EXPECT_FALSE(read_telemetry(telecommand_bytes(ping())));
}

TEST(Telemetry, OfTheTimeHasNoSecondaryHeader) {
  Telemetry sent;
  sent.primary = {0, false, false, kTimeApid, 3, 0, 1};
  sent.data = "time";
  const std::string packet = telemetry_bytes(sent);
  EXPECT_EQ(packet.size(), kPrimaryBytes + 4 + kChecksumBytes);
  ASSERT_TRUE(read_telemetry(packet));
  EXPECT_EQ(read_telemetry(packet)->data, "time");
}

// 301.0-B-4 clause 3.2: seconds, then their fraction as binary places.
TEST(Time, IsSecondsAndTheirFraction) {
  std::string half;
  append_time(half, 1500000);
  EXPECT_EQ(half, octets({0, 0, 0, 1, 0x80, 0, 0}));
  for (const std::uint64_t time_us : {0ull, 1ull, 999999ull, 1780000000123457ull, 4294967295999999ull}) {
    std::string bytes;
    append_time(bytes, time_us);
    ASSERT_EQ(bytes.size(), kTimeBytes);
    EXPECT_EQ(read_time(bytes), time_us);
  }
}

TEST(PacketStream, FindsPacketsInAStreamThatIsCutAnywhere) {
  const std::string whole = telecommand_bytes(ping()) + telecommand_bytes(ping());
  for (std::size_t cut = 0; cut <= whole.size(); ++cut) {
    PacketStream stream;
    int packets = 0;
    for (const std::string& part : {whole.substr(0, cut), whole.substr(cut)}) {
      stream.add(part);
      while (const auto packet = stream.next()) packets += *packet == telecommand_bytes(ping()) ? 1 : 100;
    }
    EXPECT_EQ(packets, 2);
    EXPECT_FALSE(stream.is_lost());
  }
}

TEST(PacketStream, IsLostWhereAPacketWouldBeTooLong) {
  PacketStream stream;
  stream.add(primary_bytes({0, true, true, kArmApid, 3, 0, kMaxPacketBytes - kPrimaryBytes + 1}));
  EXPECT_FALSE(stream.next());
  EXPECT_TRUE(stream.is_lost());
}

}  // namespace
}  // namespace liana::ground
