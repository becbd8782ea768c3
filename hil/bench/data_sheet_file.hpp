// The file that `liana-bench --eds` writes.
#pragma once

#include <string>

namespace liana::bench {

// Data sheet of the bench's drive as it is where no robot table says otherwise; `path` "-" is standard output. Throws
// std::runtime_error naming a file that cannot be written.
void write_data_sheet(const std::string& path);

}  // namespace liana::bench
