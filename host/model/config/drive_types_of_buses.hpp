// Which drive of a bus table is of which type.
#pragma once

#include <cstdint>
#include <map>

#include "host/model/config/config.hpp"
#include "host/model/config/drive_type.hpp"

namespace liana::config {

// The types that a checked bus table names, by node; a drive that is not among them is a cia402_csp.
std::map<std::int32_t, DriveType> drive_types(const BusesConfig& buses);

// Refuses `drives` and `drive_types` of a bus table whose buses have been read.
void check_drive_types(const Field& table, const BusesConfig& buses);

}  // namespace liana::config
