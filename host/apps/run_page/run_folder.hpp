// From the folder of a run to its page, with the page that was built (docs/getting-started/tour-of-the-console.md).
#pragma once

#include <string>

#include "host/apps/run_page/run_data.hpp"

namespace liana::run_page {

// What the folder holds: archive, commands, report, truth; of these only the archive has to be there. Throws
// std::runtime_error with path and reason.
RunData run_in(const std::string& folder);

// The page without a run. It is made by npm, which nobody has to have: is_page_built() may be false.
std::string built_page();
bool is_page_built();

// Writes the page of a run to `file`; its size in bytes. Throws std::runtime_error with path and reason.
std::size_t write_page(const std::string& folder, const std::string& file);

}  // namespace liana::run_page
