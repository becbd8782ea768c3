// Reads the state of a Controller from bytes that may have been cut, damaged or made up, and lets nothing through that
// the core does not survive: an enumeration or a bool without meaning, a number that is not finite, a count or an index
// beyond what it counts. What it refuses it names: file, field, value, what is allowed.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <string_view>
#include <type_traits>

#include "host/storage/recording/codec.hpp"
#include "host/storage/recording/known_values.hpp"

namespace liana::recording {

constexpr double kLargestNumber = 1e12;       // of a state: far above any real one, and its products are still finite
constexpr double kLargestAngle_rad = 1000.0;  // what the core's sine is made for; fields that end in _rad

// How many of each the robot has: what indices of its state are checked against.
struct StateBounds {
  std::int32_t drives = 0, segments = 0, joints = 0, interval_ticks = 0;
  std::array<std::int32_t, 8> first_cable{};  // of each segment
};

class ImageReader {
 public:
  // `source` names the file in messages.
  ImageReader(std::string_view in, std::string source, const StateBounds& bounds)
      : reader_(in), source_(std::move(source)), bounds_(bounds) {}

  template <Scalar T>
  void operator()(const char* name, T& value) {
    if constexpr (std::is_same_v<T, bool>) {
      std::uint8_t byte = 0;
      (*this)(name, byte);
      require(name, byte, 0, 1);
      value = byte == 1;
    } else {
      if (reader_.left() < sizeof(bits_of(value))) refuse(name, "nothing", "a value: the image ends before it");
      reader_(name, value);
      check_scalar(name, value);
    }
  }
  template <class T, std::size_t N>
  void operator()(const char* name, std::array<T, N>& values) {
    for (std::size_t i = 0; i < N; ++i) (*this)((std::string(name) + "[" + std::to_string(i) + "]").c_str(), values[i]);
  }
  template <class T>
  requires std::is_class_v<T>
  void operator()(const char* name, T& value) {
    const std::size_t length = path_.size();
    path_ += std::string(name) + ".";
    visit(*this, value);
    if constexpr (requires { check(*this, value); }) check(*this, value);
    path_.resize(length);
  }

  // Refuses a value outside low..high.
  void require(const char* name, std::int64_t value, std::int64_t low, std::int64_t high) const {
    if (value < low || value > high)
      refuse(name, std::to_string(value), std::to_string(low) + ".." + std::to_string(high));
  }
  // Refuses a mask with bits above the first `count`.
  void require_mask(const char* name, std::uint32_t mask, std::int32_t count) const {
    require(name, mask, 0, (std::int64_t{1} << count) - 1);
  }
  // Throws std::runtime_error.
  [[noreturn]] void refuse(const char* name, const std::string& value, const std::string& allowed) const;
  // Refuses bytes behind the last field.
  void require_end() const;

  const StateBounds& bounds() const { return bounds_; }
  std::size_t position() const { return reader_.position(); }

 private:
  template <Scalar T>
  void check_scalar(const char* name, T value) const {
    if constexpr (std::is_enum_v<T>) {
      if (!is_known(value)) refuse(name, std::to_string(static_cast<int>(value)), "a value that has a meaning");
    } else if constexpr (std::is_same_v<T, double>) {
      check_number(name, value);
    }
  }
  void check_number(std::string_view name, double value) const;

  Reader reader_;
  std::string source_, path_;
  StateBounds bounds_;
};

}  // namespace liana::recording
