// The electronic data sheet (EDS, CiA 306) of a simulated drive: what other makers' masters and tools load to know its
// objects by name.
#pragma once

#include <string>

#include "hil/drive/drive_objects.hpp"

namespace liana::bench {

// The dictionary of make_objects() as an EDS, for any node id: COB-IDs are given as $NODEID+... . The serial number has
// no default, since it is the single drive's. Always the same text for the same settings.
std::string data_sheet(const DriveSettings& settings);

}  // namespace liana::bench
