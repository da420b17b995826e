#include "interfaces/laser_log/bag_reader.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "interfaces/laser_log/log_fields.hpp"

namespace swiftlet::interfaces {
namespace {

using common::Message;

constexpr std::string_view kAnyVersion = "#ROSBAG V";
constexpr std::string_view kMagic = "#ROSBAG V2.0\n";
/// Greatest sizes. Headers contain numbers, a topic and a few words; the data of a connection contain the definition of
/// its type.
constexpr std::uint32_t kMostHeaderBytes = 1U << 16;
constexpr std::uint32_t kMostConnectionBytes = 1U << 20;
constexpr std::size_t kMostConnections = 10'000;
constexpr std::uint32_t kIndexEntryBytes = 12;

enum Op : unsigned char { kMessageOp = 2, kBagHeaderOp = 3, kIndexOp = 4, kChunkOp = 5, kConnectionOp = 7 };

/// The value of a field of a header. Each field is a length followed by "name=value".
std::optional<std::string_view> find(std::string_view header, std::string_view name) {
  for (MessageCursor cursor(header); cursor.left() > 0 && cursor.whole();) {
    const std::string_view field = cursor.text();
    const std::size_t equals = field.find('=');
    if (equals != std::string_view::npos && field.substr(0, equals) == name) return field.substr(equals + 1);
  }
  return std::nullopt;
}

std::string_view require(std::string_view header, const char* name, std::size_t bytes = 0) {
  const auto value = find(header, name);
  if (!value || (bytes > 0 && value->size() != bytes))
    throw StreamFailure{fmt::format("a record without its `{}`", name)};
  return *value;
}

std::uint32_t requireU32(std::string_view header, const char* name) {
  return MessageCursor(require(header, name, 4)).u32();
}

int opOf(std::string_view header) { return static_cast<unsigned char>(require(header, "op", 1).front()); }

}  // namespace

bool isBag(std::string_view first_bytes) { return first_bytes.starts_with(kAnyVersion); }

/// The records of a chunk, unpacked if necessary.
struct BagReader::Chunk {
  StreamCursor& file;
  std::uint32_t left;
  std::optional<UnpackedStream> unpacked;
  StreamCursor records;

  Chunk(StreamCursor& file_in, std::uint32_t bytes, bool packed)
      : file(file_in), left(bytes), records([this](char* to, std::size_t count) {
          return unpacked ? unpacked->read(to, count) : takeFromFile(to, count);
        }) {
    if (packed)
      unpacked =
          UnpackedStream::fromSource([this](char* to, std::size_t count) { return takeFromFile(to, count); }, "chunk");
  }

  BytesRead takeFromFile(char* to, std::size_t count) {
    BytesRead taken = file.some(to, std::min<std::size_t>(count, left));
    left -= static_cast<std::uint32_t>(taken.value_or(0));
    return taken;
  }
};

BagReader::BagReader(UnpackedStream stream, Options options)
    : stream_(std::move(stream)),
      options_(std::move(options)),
      file_([this](char* to, std::size_t count) { return stream_.read(to, count); }) {
  try {
    if (file_.bytes(kMagic.size()) == kMagic) return;
  } catch (const StreamFailure&) {}
  throw common::InputError({name()}, "", Message("bag.other-version", "is no bag of version 2.0"),
                           "`rosbag migrate` brings older ones up to it");
}

BagReader::~BagReader() = default;

bool BagReader::next(BagMessage& message) {
  Taken taken = Taken::kOther;
  while (taken == Taken::kOther) taken = chunk_ ? takeFromChunk(message) : takeFromFile(message);
  return taken == Taken::kMessage;
}

BagReader::Taken BagReader::takeFromFile(BagMessage& message) {
  const std::uint64_t offset = file_.offset();
  try {
    if (file_.atEnd()) {
      if (chunks_ < least_chunks_)
        throw StreamFailure{fmt::format("it has {} of the {} chunks its header tells of", chunks_, least_chunks_)};
      return Taken::kEnd;
    }
    const std::string record = header(file_);
    const int op = opOf(record);
    if (op == kMessageOp) return readMessage(record, file_, message);
    if (op == kConnectionOp) {
      readConnection(record, file_);
    } else if (op == kChunkOp) {
      openChunk(record, file_.u32());
    } else if (op == kIndexOp) {
      // The length in its header is not used: writers of some years got it wrong.
      (void)file_.u32();
      file_.skip(std::uint64_t{kIndexEntryBytes} * requireU32(record, "count"));
    } else {
      if (op == kBagHeaderOp) readBagHeader(record);
      file_.skip(file_.u32());
    }
    return Taken::kOther;
  } catch (const StreamFailure& failure) {
    throw cutAt(offset, failure);
  }
}

/// Damage within one chunk does not affect the next one.
BagReader::Taken BagReader::takeFromChunk(BagMessage& message) {
  StreamCursor& records = chunk_->records;
  try {
    if (!records.atEnd()) {
      const std::string record = header(records);
      const int op = opOf(record);
      if (op == kMessageOp) return readMessage(record, records, message);
      if (op == kConnectionOp)
        readConnection(record, records);
      else
        records.skip(records.u32());
      return Taken::kOther;
    }
  } catch (const StreamFailure& failure) {
    options_.onProblem(
        Message("bag.chunk-damaged", "the chunk before byte {} is damaged: {}", file_.offset(), failure.message));
  }
  leaveChunk();
  return Taken::kOther;
}

/// Afterwards the file is positioned after the chunk.
void BagReader::leaveChunk() {
  const std::uint32_t left = chunk_->left;
  const std::uint64_t offset = file_.offset();
  chunk_.reset();
  try {
    file_.skip(left);
  } catch (const StreamFailure& failure) {
    throw cutAt(offset, failure);
  }
}

common::InputError BagReader::cutAt(std::uint64_t offset, const StreamFailure& failure) const {
  return common::InputError({name()}, fmt::format("byte {}", offset),
                            Message("file.damaged", "is cut or damaged, its end cannot be read"), failure.message);
}

std::string BagReader::header(StreamCursor& from) {
  const std::uint32_t bytes = from.u32();
  if (bytes > kMostHeaderBytes) throw StreamFailure{fmt::format("a header of {} bytes", bytes)};
  return std::string(from.bytes(bytes));
}

void BagReader::readBagHeader(const std::string& header) {
  if (const auto encryptor = find(header, "encryptor"); encryptor && !encryptor->empty())
    throw common::InputError({name()}, "", Message("bag.encrypted", "is encrypted by {}", shown(*encryptor)),
                             "`rosbag decrypt` gives one that can be read");
  // A writer fills this in at its end; until then the position of the index is zero.
  const auto index = find(header, "index_pos"), chunks = find(header, "chunk_count");
  if (index && chunks && index->find_first_not_of('\0') != std::string_view::npos)
    least_chunks_ = MessageCursor(*chunks).u32();
}

void BagReader::openChunk(const std::string& header, std::uint32_t bytes) {
  ++chunks_;
  const std::string_view packing = require(header, "compression");
  if (packing == "none" || packing == "bz2" || packing == "lz4") {
    chunk_ = std::make_unique<Chunk>(file_, bytes, packing != "none");
    return;
  }
  options_.onProblem(Message("bag.chunk-packing", "a chunk at byte {} is packed by `{}`, which is not known",
                             file_.offset(), shown(packing)));
  file_.skip(bytes);
}

void BagReader::readConnection(const std::string& header, StreamCursor& from) {
  const std::uint32_t id = requireU32(header, "conn"), bytes = from.u32();
  if (bytes > kMostConnectionBytes) throw StreamFailure{fmt::format("a connection of {} bytes", bytes)};
  const std::string_view data = from.bytes(bytes);
  if (connections_.contains(id)) return;  // Every chunk, and the end of the file, may repeat a connection.
  if (connections_.size() >= kMostConnections) throw StreamFailure{"more connections than any robot has"};
  connections_[id] = {std::string(require(header, "topic")), std::string(require(data, "type")),
                      std::string(find(data, "md5sum").value_or(""))};
}

BagReader::Taken BagReader::readMessage(const std::string& header, StreamCursor& from, BagMessage& message) {
  const auto connection = connections_.find(requireU32(header, "conn"));
  const std::uint32_t bytes = from.u32();
  if (connection == connections_.end() || !options_.wanted(connection->second)) {
    from.skip(bytes);
    return Taken::kOther;
  }
  MessageCursor time(require(header, "time", 8));
  const std::int64_t seconds = time.u32(), nanoseconds = time.u32();
  message.connection = &connection->second;
  message.recorded = common::Time::fromNanoseconds(seconds * 1'000'000'000 + nanoseconds);
  message.bytes = bytes;
  message.data = {};
  if (bytes <= options_.most_bytes)
    message.data = from.bytes(bytes);
  else
    from.skip(bytes);
  return Taken::kMessage;
}

}  // namespace swiftlet::interfaces
