// The messages of a rosbag 1 file (format 2.0), in the order of the file. Source: the published description of the
// format, wiki.ros.org/Bags/Format/2.0.
//
//   #ROSBAG V2.0 | bag header | chunk, indices of it | chunk, indices of it | ... | connections | chunk infos
//                               '-> connections and messages, plain or packed by bz2 or lz4
//
// It is read as a stream: the indices are not used, so neither the length of a bag nor a writer that was killed
// matters.
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

/// The type of the messages of a topic, from one publisher.
struct BagConnection {
  std::string topic;
  std::string type;    ///< "sensor_msgs/LaserScan".
  std::string md5sum;  ///< Hash of the definition of the type.
};

struct BagMessage {
  const BagConnection* connection = nullptr;
  common::Time recorded;
  std::string_view data;  ///< Valid until the next call; empty if it is longer than the limit.
  std::uint32_t bytes = 0;
};

/// Whether a file begins like a bag, of any version.
bool isBag(std::string_view first_bytes);

/// Used by one thread.
class BagReader {
 public:
  /// Returns only messages of connections that are `wanted`, with their data up to `most_bytes`. A problem within a
  /// chunk is passed to `onProblem`; the rest of that chunk is left out.
  struct Options {
    std::function<bool(const BagConnection&)> wanted;
    std::size_t most_bytes = 0;
    std::function<void(common::Message message)> onProblem;
  };

  /// Throws InputError if this is not a bag of version 2.0.
  BagReader(UnpackedStream stream, Options options);
  ~BagReader();

  /// False after the last message. Throws InputError with the place if the file is cut or damaged; also if it ends
  /// between two records although its header promises more chunks.
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
  std::unique_ptr<Chunk> chunk_;    ///< The chunk that is being read.
  std::uint64_t chunks_ = 0;        ///< Number of chunks read so far.
  std::uint64_t least_chunks_ = 0;  ///< Number of chunks that the header promises; 0 if it says nothing.
  std::map<std::uint32_t, BagConnection> connections_;
};

}  // namespace swiftlet::interfaces
