#include "host/api/ground/packet.hpp"

#include <array>

namespace liana::ground {
namespace {

constexpr std::uint8_t kPusVersion = 2;  // PUS-C
constexpr std::uint64_t kPerSecond = 1000000;
constexpr unsigned kFractionBits = 24;

constexpr std::array<std::uint16_t, 256> table() {
  std::array<std::uint16_t, 256> out{};
  for (unsigned i = 0; i < out.size(); ++i) {
    unsigned value = i << 8u;
    for (int bit = 0; bit < 8; ++bit) value = (value & 0x8000u) != 0 ? (value << 1u) ^ 0x1021u : value << 1u;
    out[i] = static_cast<std::uint16_t>(value);
  }
  return out;
}
constexpr auto kTable = table();

std::string closed(PrimaryHeader primary, const std::string& data) {
  primary.data_bytes = static_cast<std::uint32_t>(data.size() + kChecksumBytes);
  std::string out = primary_bytes(primary) + data;
  append_whole(out, checksum(out), kChecksumBytes);
  return out;
}

bool is_whole(const std::optional<PrimaryHeader>& header, std::string_view bytes) {
  return header && bytes.size() == header->packet_bytes() && bytes.size() <= kMaxPacketBytes &&
         header->data_bytes >= kChecksumBytes;
}

}  // namespace

std::optional<PrimaryHeader> read_primary(std::string_view bytes) {
  if (bytes.size() < kPrimaryBytes) return std::nullopt;
  const std::uint64_t word = read_whole(bytes.substr(0, kPrimaryBytes));
  PrimaryHeader out;
  out.version = static_cast<std::uint8_t>(word >> 45u & 7u);
  out.is_telecommand = (word >> 44u & 1u) != 0;
  out.has_secondary = (word >> 43u & 1u) != 0;
  out.apid = static_cast<std::uint16_t>(word >> 32u & 0x7ffu);
  out.segment = static_cast<std::uint8_t>(word >> 30u & 3u);
  out.count = static_cast<std::uint16_t>(word >> 16u & 0x3fffu);
  out.data_bytes = static_cast<std::uint32_t>((word & 0xffffu) + 1);
  return out;
}

std::string primary_bytes(const PrimaryHeader& header) {
  std::uint64_t word = header.version & 7u;
  word = word << 1u | (header.is_telecommand ? 1u : 0u);
  word = word << 1u | (header.has_secondary ? 1u : 0u);
  word = word << 11u | (header.apid & 0x7ffu);
  word = word << 2u | (header.segment & 3u);
  word = word << 14u | (header.count & 0x3fffu);
  word = word << 16u | ((header.data_bytes - 1) & 0xffffu);
  std::string out;
  append_whole(out, word, kPrimaryBytes);
  return out;
}

std::uint16_t checksum(std::string_view bytes) {
  std::uint16_t value = 0xffff;
  for (const char each : bytes) {
    const auto place = static_cast<std::uint8_t>(value >> 8u) ^ static_cast<std::uint8_t>(each);
    value = static_cast<std::uint16_t>(static_cast<unsigned>(value) << 8u ^ kTable[static_cast<std::size_t>(place)]);
  }
  return value;
}

void append_whole(std::string& out, std::uint64_t value, std::size_t bytes) {
  for (std::size_t i = bytes; i-- > 0;) out += static_cast<char>(value >> 8u * i & 0xffu);
}

std::uint64_t read_whole(std::string_view bytes) {
  std::uint64_t value = 0;
  for (const char each : bytes) value = value << 8u | static_cast<std::uint8_t>(each);
  return value;
}

void append_time(std::string& out, std::uint64_t time_us) {
  const std::uint64_t part = ((time_us % kPerSecond << kFractionBits) + kPerSecond / 2) / kPerSecond;
  append_whole(out, (time_us / kPerSecond << kFractionBits) + part, kTimeBytes);
}

std::uint64_t read_time(std::string_view bytes) {
  const std::uint64_t word = read_whole(bytes.substr(0, kTimeBytes));
  const std::uint64_t part = word & ((1u << kFractionBits) - 1);
  return (word >> kFractionBits) * kPerSecond + ((part * kPerSecond + (1u << (kFractionBits - 1))) >> kFractionBits);
}

Failure read_telecommand(std::string_view bytes, Telecommand& out) {
  const auto primary = read_primary(bytes);
  if (primary) out.primary = *primary;
  if (!is_whole(primary, bytes)) return Failure::kLength;
  if (checksum(bytes) != 0) return Failure::kChecksum;
  if (primary->version != 0 || !primary->is_telecommand || !primary->has_secondary || primary->segment != 3)
    return Failure::kHeader;
  const std::string_view body = bytes.substr(kPrimaryBytes, primary->data_bytes - kChecksumBytes);
  if (body.size() < kTelecommandHeaderBytes) return Failure::kLength;
  const auto at = [body](std::size_t i) { return static_cast<std::uint8_t>(body[i]); };
  if (at(0) >> 4u != kPusVersion) return Failure::kHeader;
  out.acknowledge = at(0) & 15u;
  out.service = at(1);
  out.subtype = at(2);
  out.source = static_cast<std::uint16_t>(read_whole(body.substr(3, 2)));
  out.data = body.substr(kTelecommandHeaderBytes);
  return Failure::kNone;
}

std::string telecommand_bytes(const Telecommand& telecommand) {
  PrimaryHeader primary = telecommand.primary;
  primary.is_telecommand = primary.has_secondary = true;
  std::string data;
  append_whole(data, static_cast<std::uint64_t>(kPusVersion << 4u | (telecommand.acknowledge & 15u)), 1);
  append_whole(data, telecommand.service, 1);
  append_whole(data, telecommand.subtype, 1);
  append_whole(data, telecommand.source, 2);
  return closed(primary, data + telecommand.data);
}

std::optional<Telemetry> read_telemetry(std::string_view bytes) {
  const auto primary = read_primary(bytes);
  if (!is_whole(primary, bytes) || checksum(bytes) != 0) return std::nullopt;
  if (primary->version != 0 || primary->is_telecommand || primary->segment != 3) return std::nullopt;
  std::string_view body = bytes.substr(kPrimaryBytes, primary->data_bytes - kChecksumBytes);
  Telemetry out;
  out.primary = *primary;
  if (primary->has_secondary) {
    if (body.size() < kTelemetryHeaderBytes || static_cast<std::uint8_t>(body[0]) >> 4u != kPusVersion)
      return std::nullopt;
    out.service = static_cast<std::uint8_t>(body[1]);
    out.subtype = static_cast<std::uint8_t>(body[2]);
    out.message_count = static_cast<std::uint16_t>(read_whole(body.substr(3, 2)));
    out.destination = static_cast<std::uint16_t>(read_whole(body.substr(5, 2)));
    out.time_us = read_time(body.substr(7));
    body.remove_prefix(kTelemetryHeaderBytes);
  }
  out.data = body;
  return out;
}

std::string telemetry_bytes(const Telemetry& telemetry) {
  if (!telemetry.primary.has_secondary) return closed(telemetry.primary, telemetry.data);
  std::string data;
  append_whole(data, kPusVersion << 4u, 1);  // the time is not known to be synchronized: status 0
  append_whole(data, telemetry.service, 1);
  append_whole(data, telemetry.subtype, 1);
  append_whole(data, telemetry.message_count, 2);
  append_whole(data, telemetry.destination, 2);
  append_time(data, telemetry.time_us);
  return closed(telemetry.primary, data + telemetry.data);
}

std::optional<std::string> PacketStream::next() {
  const auto header = read_primary(waiting_);
  lost_ = lost_ || (header && header->packet_bytes() > kMaxPacketBytes);
  if (lost_ || !header || waiting_.size() < header->packet_bytes()) return std::nullopt;
  std::string packet = waiting_.substr(0, header->packet_bytes());
  waiting_.erase(0, packet.size());
  return packet;
}

}  // namespace liana::ground
