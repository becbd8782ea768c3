#include "host/storage/recording/image_reader.hpp"

#include <array>
#include <cstdio>
#include <stdexcept>

namespace liana::recording {

namespace {

std::string short_text(double value) {
  std::array<char, 40> text{};
  std::snprintf(text.data(), text.size(), "%g", value);
  return text.data();
}

}  // namespace

void ImageReader::refuse(const char* name, const std::string& value, const std::string& allowed) const {
  throw std::runtime_error("recording " + source_ + ": controller image: field " + path_ + name + ": " + value +
                           "; allowed is " + allowed + "; take a good copy of the file");
}

void ImageReader::require_end() const {
  if (reader_.left() > 0)
    refuse("end", std::to_string(reader_.left()) + " more bytes", "nothing behind the last field");
}

void ImageReader::check_number(std::string_view name, double value) const {
  const std::string_view field = name.substr(0, name.find('['));
  const double most = field.ends_with("_rad") ? kLargestAngle_rad : kLargestNumber;
  if (!(std::fabs(value) <= most))
    refuse(std::string(name).c_str(), short_text(value), "a finite number up to " + short_text(most));
}

}  // namespace liana::recording
