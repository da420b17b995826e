#include "interfaces/files/line_reader.hpp"

#include <cstring>
#include <utility>

#include <archive.h>
#include <archive_entry.h>
#include <fmt/format.h>

#include "common/read_bytes.hpp"

namespace swiftlet::interfaces {
namespace {

using common::InputError;
using common::Problem;

constexpr std::size_t kBlockBytes = std::size_t{1} << 16;

}  // namespace

void LineReader::ArchiveDeleter::operator()(struct archive* opened) const { archive_read_free(opened); }

LineReader::LineReader(std::string name, LineLimits limits)
    : name_(std::move(name)), limits_(limits), archive_(archive_read_new()) {
  archive_read_support_filter_gzip(archive_.get());
  archive_read_support_filter_bzip2(archive_.get());
  archive_read_support_filter_xz(archive_.get());
  archive_read_support_format_raw(archive_.get());
  archive_read_support_format_empty(archive_.get());
}

LineReader::LineReader(const std::filesystem::path& file, LineLimits limits) : LineReader(file.string(), limits) {
  common::requireFile(file);
  begin(archive_read_open_filename(archive_.get(), file.c_str(), kBlockBytes));
}

LineReader LineReader::fromBytes(std::string_view bytes, std::string name, LineLimits limits) {
  LineReader reader(std::move(name), limits);
  reader.begin(archive_read_open_memory(reader.archive_.get(), bytes.data(), bytes.size()));
  return reader;
}

LineReader::~LineReader() = default;
LineReader::LineReader(LineReader&&) noexcept = default;
LineReader& LineReader::operator=(LineReader&&) noexcept = default;

void LineReader::begin(int open_result) {
  const int error_number = archive_errno(archive_.get());
  if (open_result != ARCHIVE_OK && error_number > 0)
    throw problemAt(0, "", fmt::format("cannot be opened: {}", std::strerror(error_number)));
  struct archive_entry* entry = nullptr;
  const int result = open_result == ARCHIVE_OK ? archive_read_next_header(archive_.get(), &entry) : open_result;
  at_end_ = result == ARCHIVE_EOF;
  if (result != ARCHIVE_OK && !at_end_) throw unpackingProblem();
}

bool LineReader::next(std::string_view& line) {
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
  ++line_number_;
  line_ended_ = ended;
  line = std::string_view(buffer_).substr(taken_, ended ? end - taken_ : std::string::npos);
  if (line.size() > limits_.line_bytes)
    throw problemAt(0, "", fmt::format("a line of more than {} bytes", limits_.line_bytes));
  taken_ = ended ? end + 1 : buffer_.size();
  if (line.ends_with('\r')) line.remove_suffix(1);
  return true;
}

void LineReader::readBlock() {
  const std::size_t before = buffer_.size();
  buffer_.resize(before + kBlockBytes);
  const la_ssize_t count = archive_read_data(archive_.get(), buffer_.data() + before, kBlockBytes);
  buffer_.resize(before + static_cast<std::size_t>(count > 0 ? count : 0));
  if (count < 0) throw unpackingProblem();
  at_end_ = count == 0;
  unpacked_bytes_ += count;
  if (unpacked_bytes_ > limits_.file_bytes)
    throw problemAt(0, "", fmt::format("the file holds more than {} bytes", limits_.file_bytes));
}

InputError LineReader::unpackingProblem() const {
  const char* text = archive_error_string(archive_.get());
  return problemAt(0, "", "is cut or damaged, its end cannot be read", text == nullptr ? "" : text);
}

InputError LineReader::problemAt(int column, std::string element, std::string message, std::string hint) const {
  return InputError(Problem{{name_, line_number_, column}, std::move(element), std::move(message), std::move(hint)});
}

std::int64_t LineReader::packedBytesRead() const { return archive_filter_bytes(archive_.get(), -1); }

}  // namespace swiftlet::interfaces
