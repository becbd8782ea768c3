// CCSDS Space Packets (133.0-B-2) with the secondary headers of PUS-C (ECSS-E-ST-70-41C): bytes to fields and back.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace liana::ground {

constexpr std::size_t kPrimaryBytes = 6;            // primary header
constexpr std::size_t kTelecommandHeaderBytes = 5;  // secondary header of a telecommand
constexpr std::size_t kTelemetryHeaderBytes = 14;   // secondary header of telemetry, time included
constexpr std::size_t kTimeBytes = 7;               // CUC: 4 octets of seconds, 3 of their fraction
constexpr std::size_t kChecksumBytes = 2;
constexpr std::size_t kMaxPacketBytes = 4096;   // of this mission; the standard allows 65542
constexpr std::uint16_t kIdleApid = 2047;       // of idle packets, 133.0-B-2 clause 4.1.3.3.4
constexpr std::uint16_t kArmApid = 100;         // of the arm, both ways
constexpr std::uint16_t kTimeApid = 0;          // of time packets, which have no secondary header
constexpr std::uint16_t kCountModulus = 16384;  // of sequence counts

// Bits of a telecommand's acknowledgement flags: which successes are to be reported. Failures always are.
enum Acknowledge : std::uint8_t {
  kAcknowledgeAcceptance = 1,
  kAcknowledgeStart = 2,
  kAcknowledgeProgress = 4,
  kAcknowledgeCompletion = 8,
};

struct PrimaryHeader {
  std::uint8_t version = 0;  // 0 to 7; 0: Space Packet
  bool is_telecommand = false;
  bool has_secondary = false;
  std::uint16_t apid = 0;        // 0 to 2047
  std::uint8_t segment = 3;      // sequence flags, 0 to 3; 3: not segmented
  std::uint16_t count = 0;       // 0 to 16383
  std::uint32_t data_bytes = 1;  // after this header, 1 to 65536

  std::size_t packet_bytes() const { return kPrimaryBytes + data_bytes; }
  bool operator==(const PrimaryHeader&) const = default;
};

// The first six octets as fields; nothing when there are fewer.
std::optional<PrimaryHeader> read_primary(std::string_view bytes);
// Six octets. Fields are cut to their bits.
std::string primary_bytes(const PrimaryHeader& header);

// CRC-16-CCITT: polynomial 1021h, begins with FFFFh, no reflection (ECSS-E-ST-70-41C annex B).
std::uint16_t checksum(std::string_view bytes);

// Whole numbers, the first octet the highest. `bytes` 1 to 8.
void append_whole(std::string& out, std::uint64_t value, std::size_t bytes);
std::uint64_t read_whole(std::string_view bytes);

// CUC time (301.0-B-4 clause 3.2) without a preamble: microseconds since 1970-01-01 as seconds and 2^-24 of them. Both
// ways exact for times before 2106-02-07.
void append_time(std::string& out, std::uint64_t time_us);
std::uint64_t read_time(std::string_view bytes);

// Why a packet is no telecommand, as the failure code of its report (docs/reference/ground-packets.md).
enum class Failure : std::uint16_t {
  kNone = 0,
  // 1 to 8: error codes of the API, in the order of docs/reference/api.md.
  kRefused = 7,
  // 21 on: found by the ground segment's on-board end.
  kLength = 21,          // length of the packet
  kChecksum = 22,        // packet error control
  kHeader = 23,          // version, type, segmentation, secondary header
  kApid = 24,            // routing
  kService = 25,         // service type or subtype
  kFunction = 26,        // function id, structure id, packet store
  kArgument = 27,        // length of the arguments, or a word without a meaning
  kTooMany = 28,         // telecommands that are not completed yet
  kAway = 29,            // lianad is not there, or left before the answer
  kNoConfirmation = 30,  // no answer, or no completion in time
  kNotReached = 31,      // ended before its goal
  kStopped = 32,         // ended by an emergency stop
  kNotOwner = 33,        // another client owns motion
  kLinkLost = 34,        // the link to the ground was lost
  // 101 to 299: refusal codes of verification; 1000 on: fault numbers.
};

struct Telecommand {
  PrimaryHeader primary{};
  std::uint8_t acknowledge = 15;  // bits of Acknowledge
  std::uint8_t service = 0, subtype = 0;
  std::uint16_t source = 0;
  std::string data{};  // between secondary header and checksum
};

// The telecommand of these octets, or why they are none; `out` has what could be read. An APID is not judged.
Failure read_telecommand(std::string_view bytes, Telecommand& out);
// Its octets, checksum included. The length in `primary` is not used.
std::string telecommand_bytes(const Telecommand& telecommand);

struct Telemetry {
  PrimaryHeader primary{};
  std::uint8_t service = 0, subtype = 0;  // of packets with a secondary header
  std::uint16_t message_count = 0;        // of this service and subtype
  std::uint16_t destination = 0;          // the source of the telecommand that it answers; 0: everybody
  std::uint64_t time_us = 0;              // since 1970-01-01
  std::string data{};                     // between secondary header, where there is one, and checksum
};

// Telemetry of these octets; nothing when length, type, version or checksum is wrong.
std::optional<Telemetry> read_telemetry(std::string_view bytes);
std::string telemetry_bytes(const Telemetry& telemetry);

// Packets of a stream of octets that is cut anywhere (TCP).
class PacketStream {
 public:
  // Takes what has arrived; at most kMaxPacketBytes wait here when next() is called until it gives nothing.
  void add(std::string_view bytes) { waiting_ += bytes; }
  // The next whole packet, or nothing yet.
  std::optional<std::string> next();
  // A header announces more than kMaxPacketBytes: where the next packet begins is not known any more.
  bool is_lost() const { return lost_; }

 private:
  std::string waiting_;
  bool lost_ = false;
};

}  // namespace liana::ground
