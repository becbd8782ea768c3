// How busy a bus can get at worst, and the checks that follow from it.
#pragma once

#include <cstdint>

#include "host/model/config/config.hpp"

namespace liana::bus {

// What goes over one bus.
struct LoadTerms {
  double rate_hz = 0.0;
  int drives = 0;
  int rpdo_bytes = 6;
  int tpdo_bytes = 8;
  double heartbeats_per_s = 0.0;  // of all nodes together
  double sdo_pairs_per_s = 20.0;  // request and response, 8 bytes each
  double other_bits_per_s = 0.0;  // what torque drives, wrist sensor and adapter have besides
};

// Bits per second with worst-case stuffing: SYNC, one RPDO and one TPDO per drive each period, heartbeats, SDO.
double worst_bits_per_second(const LoadTerms& terms);

// The terms of bus `bus` of the table: every node and the master send heartbeats.
LoadTerms load_terms(const config::BusesConfig& config, std::size_t bus);

// Worst-case share of the wire of bus `bus`, SDO traffic included; over 1 it can not work.
double worst_load_with_sdo(const config::BusesConfig& config, std::size_t bus);

// Throws std::runtime_error when a bus exceeds max_load, 60C2 cannot express the period, T_c is not a whole number of
// ticks, a node id is used twice or out of 1..126, or a bus has no name or too long a one. Messages name file (the
// table), field, value and what is allowed.
void check_buses(const config::BusesConfig& config);

}  // namespace liana::bus
