#include "host/storage/recording/field_widths.hpp"

#include "host/storage/recording/codec.hpp"

namespace liana::recording {
namespace {

template <class T>
std::string widths_of(const T& value, const RecordedCounts& counts) {
  std::string widths;
  FieldWalker walker([&](const std::string&, std::size_t bytes) { widths += static_cast<char>('0' + bytes); }, counts);
  visit(walker, value);
  return widths;
}

template <class Arm>
FieldWidths widths_of_arm(const RecordedCounts& counts) {
  return {widths_of(Inputs<Arm>{}, counts) + "1", widths_of(TelecommandFields<typename Arm::Setpoint>{}, counts),
          widths_of(Outputs<Arm>{}, counts)};
}

}  // namespace

FieldWidths field_widths(bool is_serial, const RecordedCounts& counts) {
  return is_serial ? widths_of_arm<serial::SerialArm>(counts) : widths_of_arm<cable::CableArm>(counts);
}

}  // namespace liana::recording
