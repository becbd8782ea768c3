#include "host/storage/recording/images_check.hpp"

#include <filesystem>
#include <stdexcept>

#include "firmware_like/cable_controller.hpp"
#include "firmware_like/serial_controller.hpp"
#include "host/storage/recording/mcap.hpp"
#include "host/storage/recording/recording.hpp"

namespace liana::recording {

namespace {

template <class Arm>
ImagesCheck check_file(const std::filesystem::path& file) {
  ImagesCheck check;
  if (!std::filesystem::exists(file)) return check;
  check.state = "damaged";
  try {
    const McapState state = read_mcap(file, {});
    if (state == McapState::kCutShort) check.state = "cut short";
    if (state != McapState::kWhole) return check;
    McapVisitor visitor;
    visitor.message = [&](const std::string&, std::uint32_t, std::uint64_t, std::string_view data) {
      parse_image<Arm>(data);
      ++check.count;
    };
    read_mcap(file, visitor);
    check.state = "whole";
  } catch (const std::runtime_error&) {  // not MCAP, or an image that ends too early
  }
  return check;
}

}  // namespace

ImagesCheck check_images(const std::string& directory, bool is_serial) {
  const std::filesystem::path file = std::filesystem::path(directory) / kImagesFile;
  return is_serial ? check_file<serial::SerialArm>(file) : check_file<cable::CableArm>(file);
}

}  // namespace liana::recording
