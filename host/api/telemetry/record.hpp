// A state as a record of fixed size (its numbers, little-endian) and as facts (the rest, which seldom changes).
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "host/api/telemetry/layout.hpp"
#include "host/base/json/json_fwd.hpp"

namespace liana::telemetry {

// Before the values: sequence of the record and number of the facts that go with it (u32), tick and arm time (f64).
constexpr std::size_t kHeaderBytes = 24;

struct Header {
  std::uint32_t sequence = 0;
  std::uint32_t facts = 0;
  double tick = 0.0;
  double time_s = 0.0;
};

// The record; `tick` and `time_s` of the header are the state's. Values (f32) that are missing, null or no numbers are
// NaN. About 5 us.
std::string encode(const Layout& layout, const Json& state, std::uint32_t sequence, std::uint32_t facts);

// Gives a record another number of facts, when they turn out to have changed with it.
void set_facts(std::string& record, std::uint32_t facts);

// Of a record of at least kHeaderBytes.
Header header_of(const std::string& record);

// Value `i` of a place in a record of the layout's size.
float value_of(const std::string& record, const Place& place, std::size_t i);

// What else the state says: without the numbers of the layout, its time, its events, and a verdict that refused
// nothing.
Json facts_of(Json state);

}  // namespace liana::telemetry
