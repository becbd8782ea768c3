// Images of a Controller with one field changed by name.
#pragma once

#include <array>
#include <optional>
#include <stdexcept>
#include <string>

#include "host/storage/recording/codec.hpp"
#include "host/storage/recording/image.hpp"
#include "host/storage/recording/visit_cable_state.hpp"
#include "host/storage/recording/visit_serial_state.hpp"

namespace liana::recording {

// Finds where a field, by its path, begins in the bytes that Writer makes of a structure.
class FieldFinder {
 public:
  explicit FieldFinder(std::string wanted) : wanted_(std::move(wanted)) {}
  template <Scalar T>
  void operator()(const char* name, const T& value) {
    if (path_ + name == wanted_) found_ = at_;
    at_ += sizeof(bits_of(value));
  }
  template <class T, std::size_t N>
  void operator()(const char* name, const std::array<T, N>& values) {
    for (std::size_t i = 0; i < N; ++i) (*this)((std::string(name) + "[" + std::to_string(i) + "]").c_str(), values[i]);
  }
  template <class T>
  requires std::is_class_v<T>
  void operator()(const char* name, const T& value) {
    const std::size_t length = path_.size();
    path_ += std::string(name) + ".";
    visit(*this, value);
    path_.resize(length);
  }
  std::optional<std::size_t> found() const { return found_; }

 private:
  std::string wanted_, path_;
  std::size_t at_ = 0;
  std::optional<std::size_t> found_;
};

template <class Arm>
std::string state_of(const Controller<Arm>& controller) {
  std::string bytes;
  append_state(bytes, controller);
  return bytes;
}

// The state with `value` in place of a field, e.g. "faults.count"; std::logic_error when there is none of this name.
template <class Arm, class T>
std::string with_field(const Controller<Arm>& controller, const std::string& field, T value) {
  FieldFinder finder("controller." + field);
  finder("controller", controller);
  std::string bytes = state_of(controller), written;
  Writer writer(written);
  writer("", value);
  if (!finder.found()) throw std::logic_error("there is no field " + field);
  return bytes.replace(*finder.found(), written.size(), written);
}

}  // namespace liana::recording
