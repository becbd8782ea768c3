// The page that every run leaves.
#pragma once

#include <cstdio>
#include <string>

namespace liana::cli {

// Writes page.html into the folder of a run and says where it is, or how to get it, on `out`. A run whose page cannot
// be written is no worse a run: why stands on standard error.
void leave_page(const std::string& folder, std::FILE* out);

}  // namespace liana::cli
