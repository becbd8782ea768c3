// What liana-bus reads and writes besides its socket: the bus table and the statistics.
#pragma once

#include <string>

#include "host/drives/bus_simulator/bus_hub.hpp"

namespace liana::bus_simulator {

// Wires and period from the bus table (docs/reference/formats.md); nothing else in it matters here. Throws
// std::runtime_error with file and field.
void load_wires(const std::string& path, BusHubOptions& options);

// Writes per bus frames, bits, load (0..1), refused and dropped as JSON. Throws std::runtime_error when the file cannot
// be written.
void write_bus_stats(const std::string& path, const BusHub& hub);

}  // namespace liana::bus_simulator
