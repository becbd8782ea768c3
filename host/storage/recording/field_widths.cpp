#include "host/storage/recording/field_widths.hpp"

#include "host/storage/recording/codec.hpp"
#include "host/storage/recording/visit_serial.hpp"

namespace liana::recording {
namespace {

class WidthLister {
 public:
  explicit WidthLister(const RecordedCounts& counts) : counts_(counts) {}

  template <Scalar T>
  void operator()(const char*, const T& value) {
    widths_ += static_cast<char>('0' + sizeof(bits_of(value)));
  }
  template <class T, std::size_t N>
  void operator()(const char* name, const std::array<T, N>& values) {
    for (const T& value : values) (*this)(name, value);
  }
  template <class T>
  requires std::is_class_v<T>
  void operator()(const char*, const T& value) { visit(*this, value); }
  template <class T, std::size_t N>
  void first(const char* name, const std::array<T, N>& values, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) (*this)(name, values[i]);
  }
  const RecordedCounts& counts() const { return counts_; }
  const std::string& widths() const { return widths_; }

 private:
  RecordedCounts counts_;
  std::string widths_;
};

template <class T>
std::string widths_of(const T& value, const RecordedCounts& counts) {
  WidthLister lister(counts);
  visit(lister, value);
  return lister.widths();
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
