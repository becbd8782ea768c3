#include "host/storage/archive/ring_reader.hpp"

#include <algorithm>
#include <filesystem>
#include <map>
#include <stdexcept>
#include <utility>

#include "host/storage/recording/codec.hpp"
#include "host/storage/recording/crc32.hpp"

namespace liana::archive {
namespace {

// The messages of one file.
struct FileVisitor {
  std::function<void(const RingAbout&, const std::string& topic, std::string_view data)> message;
};

// Throws std::runtime_error with the file, also where a byte is not as it was written. A file that a full ring took
// away meanwhile is not there any more, and was whole.
recording::McapState read_file(const RingFile& file, const FileVisitor& visitor) {
  RingAbout about;
  recording::McapVisitor mcap;
  mcap.metadata = [&](const std::string& name, const Texts& values) {
    if (name == kRingMetadata) about = ring_about(values);
  };
  mcap.message = [&](const std::string& topic, std::uint32_t, std::uint64_t, std::string_view data) {
    visitor.message(about, topic, data);
  };
  try {
    const recording::McapState state = recording::read_mcap(file.path, mcap);
    if (state != recording::McapState::kDamaged) return state;
  } catch (const std::runtime_error& error) {
    if (!std::filesystem::exists(file.path)) return recording::McapState::kWhole;
    throw std::runtime_error(file.path + ": " + error.what());
  }
  throw std::runtime_error(
      file.path +
      ": damaged: its bytes do not match the checksum they were written with; take a good copy of the file");
}

std::uint64_t next_tick_of(std::string_view image_packet) {
  std::uint64_t next_tick = 0;
  recording::Reader reader(image_packet.substr(1));
  reader("next_tick", next_tick);
  return next_tick;
}

bool is_in(Span inner, Span span) { return inner.last >= span.first && inner.first <= span.last; }

// Those of `files` that can hold ticks of the span; each goes until the next one of its life begins.
std::vector<RingFile> around(const std::vector<RingFile>& files, Span span) {
  std::vector<RingFile> found;
  for (std::size_t i = 0; i < files.size(); ++i) {
    const std::uint64_t last = i + 1 < files.size() ? files[i + 1].first_tick - 1 : UINT64_MAX;
    if (is_in({files[i].first_tick, last}, span)) found.push_back(files[i]);
  }
  return found;
}

// The Outputs of blocks that are asked for in order, a file at a time.
class OutputsFiles {
 public:
  explicit OutputsFiles(std::vector<RingFile> files) : files_(std::move(files)) {}

  // Adds them to these ticks where they are kept. Throws std::runtime_error when they are not those of the ticks.
  void add_to(std::vector<RingTick>& ticks) {
    const RingFile* file = file_with(ticks.front().tick);
    if (file == nullptr) return;
    if (file != loaded_) load(*file);
    const auto found = blocks_.find(ticks.front().tick);
    if (found == blocks_.end()) return;
    std::vector<std::string> outputs = outputs_of(found->second, about_.widths);
    for (std::size_t i = 0; i < ticks.size(); ++i) {
      if (i >= outputs.size() || recording::crc_of(outputs[i]) != ticks[i].outputs_crc)
        throw std::runtime_error(file->path + ": tick " + std::to_string(ticks[i].tick) +
                                 ": its Outputs do not match their checksum");
      ticks[i].outputs = std::move(outputs[i]);
    }
  }

 private:
  // The newest that begins by then.
  const RingFile* file_with(std::uint64_t tick) const {
    const RingFile* found = nullptr;
    for (const RingFile& file : files_) {
      if (file.first_tick <= tick) found = &file;
    }
    return found;
  }
  void load(const RingFile& file) {
    loaded_ = &file;
    blocks_.clear();
    read_file(file, {[&](const RingAbout& about, const std::string& topic, std::string_view data) {
                if (topic != kRingOutputsTopic) return;
                about_ = about;
                blocks_[span_of_block(data).first] = data;
              }});
  }

  std::vector<RingFile> files_;
  const RingFile* loaded_ = nullptr;
  RingAbout about_;
  std::map<std::uint64_t, std::string> blocks_;  // messages by first tick
};

}  // namespace

RingReader::RingReader(const std::string& folder, std::uint64_t life) : files_(ring_files(folder)) {
  std::erase_if(files_, [life](const RingFile& file) { return file.life != life; });
}

std::vector<RingFile> RingReader::of(RingKind kind) const {
  std::vector<RingFile> found;
  const bool is_outputs = kind == RingKind::kOutputs;  // kept ones, too
  for (const RingFile& file : files_) {
    if (file.kind == kind || (is_outputs && file.kind == RingKind::kKept)) found.push_back(file);
  }
  return found;
}

std::uint64_t RingReader::bytes() const {
  std::uint64_t sum = 0;
  for (const RingFile& file : files_) sum += bytes_of(file);
  return sum;
}

std::optional<Span> RingReader::recorded() const {
  std::optional<Span> found;
  const std::vector<RingFile> inputs = of(RingKind::kInputs);
  const auto take = [&](const RingAbout&, const std::string& topic, std::string_view data) {
    if (topic != kRingInputsTopic) return;
    const Span block = span_of_block(data);
    found = {found ? found->first : block.first, block.last};
  };
  if (inputs.empty()) return found;
  read_file(inputs.front(), {take});
  if (inputs.size() > 1) read_file(inputs.back(), {take});
  return found;
}

void RingReader::visit(Span span, const RingVisitor& visitor) const {
  OutputsFiles outputs(of(RingKind::kOutputs));
  for (const RingFile& file : around(of(RingKind::kInputs), span)) {
    std::vector<std::pair<RingAbout, std::string>> blocks;
    read_file(file, {[&](const RingAbout& about, const std::string& topic, std::string_view data) {
                if (topic == kRingImageTopic && visitor.image)
                  visitor.image(about, next_tick_of(data), std::string(data));
                if (topic == kRingInputsTopic && visitor.tick && is_in(span_of_block(data), span))
                  blocks.emplace_back(about, data);
              }});
    for (const auto& [about, data] : blocks) {
      std::vector<RingTick> ticks = ticks_of(data, about.widths);
      outputs.add_to(ticks);
      for (const RingTick& tick : ticks) {
        if (tick.tick >= span.first && tick.tick <= span.last) visitor.tick(about, tick);
      }
    }
  }
}

namespace {

void check_file(const RingFile& file, RingCheck& check, std::vector<std::string>& problems) {
  check.bytes += bytes_of(file);
  ++check.files;
  try {
    if (read_file(file, {[](const auto&, const auto&, auto) {}}) == recording::McapState::kCutShort) ++check.cut_short;
  } catch (const std::runtime_error& error) {
    problems.push_back(error.what());
  }
}

}  // namespace

RingCheck check_ring(const std::string& folder, std::uint64_t life, std::vector<std::string>& problems) {
  RingCheck check;
  for (const RingFile& file : ring_files(folder)) {
    if (file.life == life) check_file(file, check, problems);
  }
  if (!problems.empty()) return check;
  RingVisitor visitor;
  visitor.image = [&](const RingAbout&, std::uint64_t, const std::string&) { ++check.images; };
  visitor.tick = [&](const RingAbout&, const RingTick& tick) {
    if (check.ticks++ == 0) check.first_tick = tick.tick;
    std::uint32_t lost_ticks = 0;
    if (check.ticks > 1) {
      recording::Reader reader(std::string_view(tick.inputs).substr(sizeof tick.tick));
      reader("lost_ticks", lost_ticks);
      check.missing += tick.tick - lost_ticks - check.last_tick - 1;
    }
    check.last_tick = tick.tick;
    check.full_ticks += tick.outputs.empty() ? 0 : 1;
  };
  try {
    RingReader(folder, life).visit(kAll, visitor);
  } catch (const std::runtime_error& error) {
    problems.push_back(error.what());
  }
  return check;
}

}  // namespace liana::archive
