#include "host/storage/archive/ring_segment.hpp"

#include <cstdlib>
#include <filesystem>
#include <stdexcept>

#include "host/storage/recording/build_id.hpp"

namespace liana::archive {
namespace {

namespace fs = std::filesystem;

Texts texts_of(const RingAbout& about) {
  return {{"build_id", about.build_id},
          {"drives", std::to_string(about.counts.drives)},
          {"thetas", std::to_string(about.counts.thetas)},
          {"segments", std::to_string(about.counts.segments)},
          {"load_cells", std::to_string(about.counts.load_cells)},
          {"inputs_widths", about.widths.inputs},
          {"telecommand_widths", about.widths.telecommand},
          {"outputs_widths", about.widths.outputs}};
}

const std::string& text_in(const Texts& texts, const char* key) {
  const auto found = texts.find(key);
  if (found == texts.end()) throw std::runtime_error(std::string("a file of the ring says nothing of ") + key);
  return found->second;
}

std::uint8_t number_in(const Texts& texts, const char* key) {
  return static_cast<std::uint8_t>(std::strtoul(text_in(texts, key).c_str(), nullptr, 10));
}

const std::string& widths_in(const Texts& texts, const char* key) {
  const std::string& widths = text_in(texts, key);
  if (widths.empty() || widths.find_first_not_of("1248") != std::string::npos)
    throw std::runtime_error(std::string("a file of the ring: ") + key + ": allowed are digits 1, 2, 4, 8");
  return widths;
}

}  // namespace

RingAbout ring_about(const Texts& metadata) {
  return {text_in(metadata, "build_id"),
          {number_in(metadata, "drives"), number_in(metadata, "thetas"), number_in(metadata, "segments"),
           number_in(metadata, "load_cells")},
          {widths_in(metadata, "inputs_widths"), widths_in(metadata, "telecommand_widths"),
           widths_in(metadata, "outputs_widths")}};
}

RingAbout ring_about(bool is_serial, const recording::RecordedCounts& counts) {
  return {recording::build_id(), counts, recording::field_widths(is_serial, counts)};
}

RingSegment::RingSegment(const std::string& path, std::uint64_t first_tick, double period_s, const RingAbout& about)
    : path_(path),
      first_tick_(first_tick),
      period_s_(period_s),
      file_(std::make_unique<recording::McapWriter>(path, "liana " + recording::build_id())) {
  file_->add_metadata(kRingMetadata, texts_of(about));
}

// What a full disk took of the last message goes, so that whole ones alone are read.
RingSegment::~RingSegment() {
  const bool has_failed = file_ && file_->has_failed();
  file_.reset();
  std::error_code none;
  if (!has_failed) return;
  good_bytes_ > 0 ? fs::resize_file(path_, good_bytes_, none) : static_cast<void>(fs::remove(path_, none));
}

void RingSegment::write(const char* topic, std::uint64_t tick, std::string_view data) {
  auto [channel, is_new] = channels_.try_emplace(topic, 0);
  if (is_new) channel->second = file_->add_channel({topic, kRingEncoding, "", ""});
  const auto time_ns = static_cast<std::uint64_t>(static_cast<double>(tick) * period_s_ * 1e9);
  file_->write_message(channel->second, static_cast<std::uint32_t>(tick), time_ns, data);
  file_->flush();
  if (file_->has_failed())
    throw std::runtime_error(path_ + ": a write failed: make room on the disk, and look at its permissions");
  good_bytes_ = fs::file_size(path_);
}

void RingSegment::finish() { file_->finish(); }

}  // namespace liana::archive
