#include "host/storage/archive/tick_block.hpp"

#include <optional>

#include "host/storage/archive/chunk.hpp"
#include "host/storage/recording/codec.hpp"
#include "host/storage/recording/crc32.hpp"

namespace liana::archive {
namespace {

constexpr std::size_t kCrcBytes = 4;
constexpr std::uint32_t kMaxTicks = 100000;  // of a message: no robot ticks so often in a second

// What stands at the front of a message.
struct Head {
  Span span;
  std::uint32_t count = 0;
};

Head head_of(recording::Reader& reader) {
  Head head;
  reader("first_tick", head.span.first);
  reader("last_tick", head.span.last);
  reader("count", head.count);
  if (head.count > kMaxTicks) throw std::runtime_error("a second of ticks is damaged; take a good copy of the file");
  return head;
}

// What packed() took, a row of so many bytes after the other.
class Rows {
 public:
  Rows(std::string_view packed_rows, std::size_t count, std::size_t bytes)
      : bytes_(bytes), all_(count == 0 ? "" : unpacked(packed_rows, count, bytes_)) {}
  std::optional<std::string_view> next() {
    if (at_ == all_.size()) return std::nullopt;
    at_ += bytes_;
    return std::string_view(all_).substr(at_ - bytes_, bytes_);
  }

 private:
  std::size_t bytes_;
  std::string all_;
  std::size_t at_ = 0;
};

}  // namespace

std::uint64_t tick_of(std::string_view fields) {
  std::uint64_t tick = 0;
  recording::Reader reader(fields);
  reader("tick", tick);
  return tick;
}

TickBlock::TickBlock(const recording::FieldWidths& widths)
    : inputs_words_(widths.inputs), telecommand_words_(widths.telecommand), outputs_words_(widths.outputs) {}

void TickBlock::add(std::string_view inputs, std::string_view outputs) {
  const std::size_t fixed = inputs_words_.bytes_of_fields();
  inputs_words_.append_words(inputs_, inputs.substr(0, fixed));
  recording::Writer writer(inputs_);
  writer("outputs_crc", recording::crc_of(outputs));
  if (inputs.size() > fixed) {
    telecommand_words_.append_words(telecommands_, inputs.substr(fixed));
    ++telecommand_count_;
  }
  outputs_words_.append_words(outputs_, outputs);
  last_tick_ = tick_of(inputs);
  if (count_++ == 0) first_tick_ = last_tick_;
}

std::string TickBlock::inputs_message() const {
  const std::string inputs = packed(inputs_, inputs_words_.bytes_of_words() + kCrcBytes);
  std::string out;
  recording::Writer writer(out);
  writer("first_tick", first_tick_);
  writer("last_tick", last_tick_);
  writer("count", count_);
  writer("telecommands", telecommand_count_);
  writer("inputs_bytes", static_cast<std::uint32_t>(inputs.size()));
  out += inputs;
  if (telecommand_count_ > 0) out += packed(telecommands_, telecommand_words_.bytes_of_words());
  return out;
}

std::string TickBlock::outputs_message() const {
  std::string out;
  recording::Writer writer(out);
  writer("first_tick", first_tick_);
  writer("last_tick", last_tick_);
  writer("count", count_);
  return out + packed(outputs_, outputs_words_.bytes_of_words());
}

void TickBlock::clear() {
  inputs_.clear();
  telecommands_.clear();
  outputs_.clear();
  count_ = telecommand_count_ = 0;
}

Span span_of_block(std::string_view message) {
  recording::Reader reader(message);
  return head_of(reader).span;
}

std::vector<RingTick> ticks_of(std::string_view inputs_message, const recording::FieldWidths& widths) {
  recording::Reader reader(inputs_message);
  const Head head = head_of(reader);
  std::uint32_t telecommand_count = 0, inputs_bytes = 0;
  reader("telecommands", telecommand_count);
  reader("inputs_bytes", inputs_bytes);
  const std::string_view rest = inputs_message.substr(reader.position());
  if (telecommand_count > head.count || inputs_bytes > rest.size())
    throw std::runtime_error("a second of ticks is damaged; take a good copy of the file");
  const PackedFields inputs_words(widths.inputs), telecommand_words(widths.telecommand);
  const std::size_t crc_at = inputs_words.bytes_of_words();
  Rows inputs(rest.substr(0, inputs_bytes), head.count, crc_at + kCrcBytes);
  Rows telecommands(rest.substr(inputs_bytes), telecommand_count, telecommand_words.bytes_of_words());
  std::vector<RingTick> ticks;
  ticks.reserve(head.count);
  while (const auto words = inputs.next()) {
    RingTick tick{.inputs = inputs_words.fields_of(*words)};
    tick.tick = tick_of(tick.inputs);
    recording::Reader crc(words->substr(crc_at));
    crc("outputs_crc", tick.outputs_crc);
    if (tick.inputs.back() != '\0') {
      if (const auto telecommand = telecommands.next()) tick.inputs += telecommand_words.fields_of(*telecommand);
    }
    ticks.push_back(std::move(tick));
  }
  return ticks;
}

std::vector<std::string> outputs_of(std::string_view outputs_message, const recording::FieldWidths& widths) {
  recording::Reader reader(outputs_message);
  const Head head = head_of(reader);
  const PackedFields outputs_words(widths.outputs);
  Rows rows(outputs_message.substr(reader.position()), head.count, outputs_words.bytes_of_words());
  std::vector<std::string> outputs;
  outputs.reserve(head.count);
  while (const auto words = rows.next()) outputs.push_back(outputs_words.fields_of(*words));
  return outputs;
}

}  // namespace liana::archive
