#include "interfaces/files/line_reader.hpp"

#include <limits>
#include <utility>

namespace swiftlet::interfaces {
namespace {

using common::InputError;
using common::Message;

constexpr std::size_t kReadBytes = std::size_t{1} << 16;
/// The byte order mark that some editors write before UTF-8.
constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";

}  // namespace

LineReader::LineReader(const std::filesystem::path& file, LineLimits limits)
    : LineReader(UnpackedStream(file), limits) {}

LineReader LineReader::fromBytes(std::string_view bytes, std::string name, LineLimits limits) {
  return {UnpackedStream::fromBytes(bytes, std::move(name)), limits};
}

bool LineReader::next(std::string_view& line) {
  if (line_cut_) dropRestOfLine();
  std::size_t searched = taken_;
  std::size_t end = buffer_.find('\n', searched);
  while (end == std::string::npos && !at_end_) {
    if (buffer_.size() - taken_ > limits_.line_bytes) break;
    searched = buffer_.size() - taken_;
    buffer_.erase(0, std::exchange(taken_, 0));
    readBlock();
    end = buffer_.find('\n', searched);
  }
  const bool ended = end != std::string::npos;
  if (!ended && at_end_ && taken_ == buffer_.size()) return false;
  if (line_number_ < std::numeric_limits<int>::max()) ++line_number_;
  line = std::string_view(buffer_).substr(taken_, ended ? end - taken_ : std::string::npos);
  if (line_number_ == 1 && line.starts_with(kByteOrderMark)) line.remove_prefix(kByteOrderMark.size());
  line_cut_ = line.size() > limits_.line_bytes;
  if (line_cut_ && !limits_.cut_long_lines)
    throw problemAt(0, "", Message("text.line-too-long", "a line of more than {} bytes", limits_.line_bytes));
  if (line_cut_) {
    line = line.substr(0, limits_.line_bytes);
    taken_ += limits_.line_bytes;
    return true;
  }
  taken_ = ended ? end + 1 : buffer_.size();
  if (line.ends_with('\r')) line.remove_suffix(1);
  return true;
}

void LineReader::dropRestOfLine() {
  line_cut_ = false;
  while (true) {
    const std::size_t end = buffer_.find('\n', taken_);
    taken_ = end == std::string::npos ? buffer_.size() : end + 1;
    if (end != std::string::npos || at_end_) return;
    buffer_.clear();
    taken_ = 0;
    readBlock();
  }
}

void LineReader::readBlock() {
  const std::size_t before = buffer_.size();
  buffer_.resize(before + kReadBytes);
  const BytesRead count = stream_.read(buffer_.data() + before, kReadBytes);
  buffer_.resize(before + count.value_or(0));
  if (!count)
    throw problemAt(0, "", Message("file.damaged", "is cut or damaged, its end cannot be read"), count.error());
  at_end_ = *count == 0;
  unpacked_bytes_ += static_cast<std::int64_t>(*count);
  if (unpacked_bytes_ > limits_.file_bytes)
    throw problemAt(0, "", Message("text.too-large", "the file holds more than {} bytes", limits_.file_bytes));
}

InputError LineReader::problemAt(int column, std::string element, Message message, std::string hint) const {
  return InputError({name(), line_number_, column}, std::move(element), std::move(message), std::move(hint));
}

}  // namespace swiftlet::interfaces
