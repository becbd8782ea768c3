// Little-endian writing and reading of visited fields: the form of recordings and of every bit comparison. Never memory
// images.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>

#include "host/storage/recording/visit.hpp"

namespace liana::recording {

template <class T>
concept Scalar = std::is_arithmetic_v<T> || std::is_enum_v<T>;

// The unsigned integer with the bits of a scalar.
template <Scalar T>
auto bits_of(T value) {
  if constexpr (std::is_same_v<T, double>) {
    return std::bit_cast<std::uint64_t>(value);
  } else if constexpr (std::is_same_v<T, bool>) {
    return static_cast<std::uint8_t>(value ? 1 : 0);
  } else if constexpr (std::is_enum_v<T>) {
    return static_cast<std::make_unsigned_t<std::underlying_type_t<T>>>(value);
  } else {
    return static_cast<std::make_unsigned_t<T>>(value);
  }
}

// Appends fields to a string.
class Writer {
 public:
  explicit Writer(std::string& out, const RecordedCounts& counts = {}) : out_(out), counts_(counts) {}

  template <Scalar T>
  void operator()(const char*, const T& value) {
    const auto bits = bits_of(value);
    std::array<char, sizeof bits> bytes{};
    for (std::size_t i = 0; i < sizeof bits; ++i)
      bytes[i] = static_cast<char>(static_cast<std::uint8_t>(bits >> (8 * i)));
    out_.append(bytes.data(), bytes.size());
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

 private:
  std::string& out_;
  RecordedCounts counts_;
};

// Reads fields back; throws std::runtime_error when the bytes end early.
class Reader {
 public:
  explicit Reader(std::string_view in, const RecordedCounts& counts = {}) : in_(in), counts_(counts) {}

  template <Scalar T>
  void operator()(const char* name, T& value) {
    using Bits = decltype(bits_of(value));
    if (in_.size() - at_ < sizeof(Bits))
      throw std::runtime_error(std::string("recording: data end inside field ") + name);
    std::uint64_t bits = 0;
    for (std::size_t i = 0; i < sizeof(Bits); ++i)
      bits |= static_cast<std::uint64_t>(static_cast<std::uint8_t>(in_[at_ + i])) << (8 * i);
    at_ += sizeof(Bits);
    if constexpr (std::is_same_v<T, double>) {
      value = std::bit_cast<double>(bits);
    } else {
      value = static_cast<T>(static_cast<Bits>(bits));
    }
  }
  template <class T, std::size_t N>
  void operator()(const char* name, std::array<T, N>& values) {
    for (T& value : values) (*this)(name, value);
  }
  template <class T>
  requires std::is_class_v<T>
  void operator()(const char*, T& value) { visit(*this, value); }
  template <class T, std::size_t N>
  void first(const char* name, std::array<T, N>& values, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) (*this)(name, values[i]);
  }
  const RecordedCounts& counts() const { return counts_; }
  // Bytes read so far, and those that are left.
  std::size_t position() const { return at_; }
  std::size_t left() const { return in_.size() - at_; }

 private:
  std::string_view in_;
  RecordedCounts counts_;
  std::size_t at_ = 0;
};

// Calls take(path, bytes) for each field of a structure, in recorded order; paths are such as "drive[3].target_counts".
template <class Take>
class FieldWalker {
 public:
  explicit FieldWalker(Take take, const RecordedCounts& counts = {}) : take_(std::move(take)), counts_(counts) {}

  template <Scalar T>
  void operator()(const char* name, const T& value) {
    take_(path_ + name, sizeof(bits_of(value)));
  }
  template <class T, std::size_t N>
  void operator()(const char* name, const std::array<T, N>& values) {
    first(name, values, N);
  }
  template <class T, std::size_t N>
  void first(const char* name, const std::array<T, N>& values, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i)
      (*this)((std::string(name) + "[" + std::to_string(i) + "]").c_str(), values[i]);
  }
  template <class T>
  requires std::is_class_v<T>
  void operator()(const char* name, const T& value) {
    const std::size_t length = path_.size();
    path_ += std::string(name) + ".";
    visit(*this, value);
    path_.resize(length);
  }
  const RecordedCounts& counts() const { return counts_; }

 private:
  Take take_;
  RecordedCounts counts_;
  std::string path_;
};

}  // namespace liana::recording
