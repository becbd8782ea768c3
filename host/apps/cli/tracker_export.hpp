// `liana log export --tracker`: what an external tracker would have written of a simulated run.
#pragma once

#include <cstdint>
#include <string>

#include "host/storage/archive/reader.hpp"

namespace liana::cli {

// The poses of a marker at the true tip as CSV (docs/reference/formats.md), 50 a second, with the noise of a tracker
// (0.2 mm, 0.1 deg about each axis). Where tracker and marker are, and what the tracker's clock says, is drawn by the
// seed of the run; where zero_s is not 0, the clock says that plus arm time. Returns the number of rows. Throws
// std::runtime_error when the run has no truth.
std::uint64_t write_tracker(const archive::Reader& reader, archive::Span span, const std::string& path, double zero_s);

}  // namespace liana::cli
