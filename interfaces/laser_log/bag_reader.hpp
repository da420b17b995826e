// The messages of a rosbag 1 file (format 2.0), in the order of the file. Source: the published description of the
// format, wiki.ros.org/Bags/Format/2.0.
//
//   #ROSBAG V2.0 | bag header | chunk, indices of it | chunk, indices of it | ... | connections | chunk infos
//                               '-> connections and messages, plain or packed by bz2 or lz4
//
// Read as it goes: the indices are not used, so neither the length of a bag nor a writer that was killed matters.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "common/error.hpp"
#include "common/time.hpp"
#include "interfaces/files/unpacked_stream.hpp"
#include "interfaces/laser_log/bag_cursor.hpp"

namespace swiftlet::interfaces {

/// What a topic carries, by one publisher.
struct BagConnection {
  std::string topic;
  std::string type;    ///< "sensor_msgs/LaserScan".
  std::string md5sum;  ///< Of the definition of the type.
};

struct BagMessage {
  const BagConnection* connection = nullptr;
  common::Time recorded;
  std::string_view data;  ///< Until the next call; empty when it is longer than was asked for.
  std::uint32_t bytes = 0;
};

/// Whether the first bytes of a file are those of a bag, of any version.
bool isBag(std::string_view first_bytes);

/// Used by one thread.
class BagReader {
 public:
  /// Only messages of connections that are `wanted` are given, their data up to `most_bytes`. What is wrong within a
  /// chunk is told by `onProblem`; the rest of that chunk is left out.
  struct Options {
    std::function<bool(const BagConnection&)> wanted;
    std::size_t most_bytes = 0;
    std::function<void(std::string message)> onProblem;
  };

  /// Throws InputError when this is no bag of version 2.0.
  BagReader(UnpackedStream stream, Options options);
  ~BagReader();

  /// False after the last. Throws InputError when the file is cut or damaged, with the place; also when it ends between
  /// two records and its header tells of more chunks.
  bool next(BagMessage& message);

  const std::map<std::uint32_t, BagConnection>& connections() const { return connections_; }
  const std::string& name() const { return stream_.name(); }
  std::int64_t packedBytesRead() const { return stream_.packedBytesRead(); }

 private:
  struct Chunk;
  enum class Taken { kMessage, kOther, kEnd };

  Taken takeFromFile(BagMessage& message);
  Taken takeFromChunk(BagMessage& message);
  void leaveChunk();
  common::InputError cutAt(std::uint64_t offset, const StreamFailure& failure) const;
  std::string header(StreamCursor& from);
  void openChunk(const std::string& header, std::uint32_t bytes);
  void readBagHeader(const std::string& header);
  void readConnection(const std::string& header, StreamCursor& from);
  Taken readMessage(const std::string& header, StreamCursor& from, BagMessage& message);

  UnpackedStream stream_;
  Options options_;
  StreamCursor file_;
  std::unique_ptr<Chunk> chunk_;    ///< The one being read.
  std::uint64_t chunks_ = 0;        ///< Met so far,
  std::uint64_t least_chunks_ = 0;  ///< and as many as the header tells of; 0 where it tells nothing.
  std::map<std::uint32_t, BagConnection> connections_;
};

}  // namespace swiftlet::interfaces
