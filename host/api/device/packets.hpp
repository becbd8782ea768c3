// Packets of liana_device.h as bytes, and what was checked in them.
#pragma once

#include <cstring>
#include <string>
#include <string_view>

#include "host/api/device/capability.hpp"
#include "host/api/device/liana_device.h"
#include "host/api/device/sample.hpp"

namespace liana::device {

constexpr std::size_t kMaxPacketBytes = sizeof(liana_state);  // of the longest packet

// A packet of which only the header is filled.
template <class Packet>
Packet make(liana_packet packet, std::uint32_t sequence = 0) {
  Packet out{};
  out.header = {LIANA_MAGIC, LIANA_VERSION, static_cast<std::uint16_t>(packet), sizeof(Packet), sequence};
  return out;
}

template <class Packet>
std::string_view bytes_of(const Packet& packet) {
  return {reinterpret_cast<const char*>(&packet), sizeof packet};
}

// What has come, by its header: its kind, or, where it is no packet of ours, what is wrong with it.
struct Incoming {
  liana_header header{};
  std::string problem;  // empty: `header.packet` is one of liana_packet, and the length is that of its struct
};
Incoming look_at(std::string_view bytes);

// The struct in bytes that look_at has found to be one.
template <class Packet>
Packet read(std::string_view bytes) {
  Packet out;
  std::memcpy(&out, bytes.data(), sizeof out);
  return out;
}

liana_hello hello_of(const Capability& capability, std::int64_t now_us);
// What a hello says; check() it.
Capability capability_of(const liana_hello& hello);

// The newest state that had come when a sample was taken.
struct Echo {
  std::uint32_t sequence = 0;  // 0: none
  std::int64_t came_us = 0;    // by the device's clock
};

liana_sample packet_of(const Sample& sample, std::uint32_t sequence, const Echo& echo);
// What is wrong with a sample of a device with so many hands: the field, and what it may be; nullptr when nothing is.
const char* problem_of(const liana_sample& packet, std::uint32_t hands);
// Of a packet in which nothing is wrong.
Sample sample_of(const liana_sample& packet);

liana_refused refused_of(std::string_view why);

// Text of a field that is filled with zeros, as far as it goes.
std::string text_of(const char* field, std::size_t bytes);

liana_pose pose_of(const Pose& pose);
Pose pose_of(const liana_pose& pose);

}  // namespace liana::device
