#include "interfaces/files/gunzip.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <memory>
#include <new>
#include <string>
#include <utility>

#include <zlib.h>

namespace swiftlet::interfaces {
namespace {

constexpr std::size_t kBlockBytes = std::size_t{1} << 16;
/// The greatest window, plus 16 for gzip: zlib then reads the header of a member and checks its trailer.
constexpr int kGzipWindow = 15 + 16;

//   +--------- a member begins ---------.
//   v                                   |
//   kMember --its trailer is right--> kBetween --end of the bytes, or only zeros to there--> the end
class Gunzip {
 public:
  explicit Gunzip(ByteSource packed) : packed_(std::move(packed)) {
    if (inflateInit2(&zlib_, kGzipWindow) != Z_OK) throw std::bad_alloc();
  }
  ~Gunzip() { inflateEnd(&zlib_); }
  Gunzip(const Gunzip&) = delete;
  Gunzip& operator=(const Gunzip&) = delete;

  BytesRead read(char* to, std::size_t bytes) {
    if (bytes == 0) return 0;
    bytes = std::min<std::size_t>(bytes, std::numeric_limits<uInt>::max());
    zlib_.next_out = reinterpret_cast<Bytef*>(to);
    zlib_.avail_out = static_cast<uInt>(bytes);
    while (zlib_.avail_out == bytes && failure_.empty() && !at_end_) {
      if (state_ == State::kMember)
        inflateOn();
      else if (zlib_.avail_in > 0)
        beginNext();
      else
        refill();
    }
    // The bytes unpacked before the failure are returned first.
    const std::size_t given = bytes - zlib_.avail_out;
    if (given == 0 && !failure_.empty()) return tl::unexpected(failure_);
    return given;
  }

 private:
  enum class State { kMember, kBetween };

  void inflateOn() {
    const int result = inflate(&zlib_, Z_NO_FLUSH);
    if (result == Z_STREAM_END)
      state_ = State::kBetween;
    else if (result == Z_BUF_ERROR)
      refill();
    else if (result != Z_OK)
      failure_ = std::string("gzip: ") + (zlib_.msg == nullptr ? "damaged" : zlib_.msg);
  }

  void refill() {
    const BytesRead count = packed_(block_.data(), block_.size());
    zlib_.next_in = reinterpret_cast<Bytef*>(block_.data());
    zlib_.avail_in = static_cast<uInt>(count.value_or(0));
    if (!count)
      failure_ = count.error();
    else if (*count == 0 && state_ == State::kMember)
      failure_ = "gzip: it ends too early";
    else
      at_end_ = *count == 0;
  }

  void beginNext() {
    if (*zlib_.next_in == 0) {
      filled_up_ = true;
      ++zlib_.next_in;
      --zlib_.avail_in;
    } else if (filled_up_ || *zlib_.next_in != static_cast<unsigned char>(kGzipMagic[0])) {
      failure_ = "gzip: it goes on behind its end";
    } else {
      inflateReset(&zlib_);
      state_ = State::kMember;
    }
  }

  ByteSource packed_;
  std::array<char, kBlockBytes> block_;
  z_stream zlib_{};
  State state_ = State::kMember;
  bool filled_up_ = false;  ///< Zeros followed the last member, so nothing but zeros may follow.
  bool at_end_ = false;
  std::string failure_;
};

}  // namespace

ByteSource gunzipped(ByteSource packed) {
  return [gunzip = std::make_shared<Gunzip>(std::move(packed))](char* to, std::size_t bytes) {
    return gunzip->read(to, bytes);
  };
}

}  // namespace swiftlet::interfaces
