#include "hil/bench/data_sheet_file.hpp"

#include <fstream>
#include <iostream>
#include <stdexcept>

#include "hil/drive/data_sheet.hpp"

namespace liana::bench {

void write_data_sheet(const std::string& path) {
  DriveSettings drive;
  drive.vendor = 0x4C49;
  drive.product = drive.revision = 1;
  const std::string text = data_sheet(drive);
  if (path == "-") {
    std::cout << text << std::flush;
    return;
  }
  std::ofstream file(path);
  file << text << std::flush;
  if (!file) throw std::runtime_error(path + ": cannot be written; allowed: a file in a folder that exists, or -");
}

}  // namespace liana::bench
